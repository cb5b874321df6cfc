#include "libskel/recognition/bone_coverage.h"

#include "tests/support/catch.h"

using namespace skel;
using Eigen::Vector2d;

namespace {

// A bar of 100 × 11 px in a plane of 60 × 100.
Plane8 bar() {
  Plane8 mask = Plane8::Zero(60, 100);
  mask.block(40, 0, 11, 100).setConstant(255);
  return mask;
}

}  // namespace

TEST_CASE("a bone along a bar covers all of it") {
  const BoneCoverage coverage = boneCoverage(bar(), {{{5, 45}, {94, 45}}});
  CHECK(coverage.outside.front() == 0);
  CHECK(coverage.uncovered == 0);
  CHECK(coverage.farthest < BoneCoverage::kNextTo);
}

TEST_CASE("a limb that no bone goes into is uncovered, as far as it reaches") {
  Plane8 mask = bar();
  mask.block(0, 80, 40, 8).setConstant(255);  // up from the bar, 40 px
  const BoneCoverage coverage = boneCoverage(mask, {{{5, 45}, {94, 45}}});
  CHECK(coverage.farthest == Approx(40).margin(4));
  CHECK(coverage.uncovered == Approx(36 * 8 / (1100 + 320.)).margin(.03));
  const BoneCoverage both = boneCoverage(mask, {{{5, 45}, {94, 45}}, {{83.5, 45}, {83.5, 3}}});
  CHECK(both.uncovered == 0);
}

TEST_CASE("ways lead through the figure, not across gaps") {
  Plane8 mask = Plane8::Zero(30, 60);
  mask.row(5).setConstant(255), mask.row(25).setConstant(255), mask.col(59).setConstant(255);
  // From the beginning of the first row to that of the last it is round by the right side.
  CHECK(boneCoverage(mask, {{{0, 5}, {0, 5}}}).farthest == Approx(59 + 20 + 59).margin(4));
}

TEST_CASE("a bone beside the figure is outside by its share, and covers nothing there") {
  const BoneCoverage coverage = boneCoverage(bar(), {{{50, 45}, {50, 5}}});
  CHECK(coverage.outside.front() == Approx(35 / 41.).margin(.03));
  CHECK(boneCoverage(bar(), {{{50, 5}, {60, 5}}}).outside.front() == 1);
  CHECK(boneCoverage(bar(), {{{-500, 5}, {900, 5}}}).outside.front() == 1);
}
