// What is said of a silhouette that was found on a page, and the file it follows from.
#include "libskel/recognition/silhouette_confidence.h"

#include <cmath>
#include <stdexcept>

#include "libskel/core/error.h"
#include "libskel/silhouette/working_grid.h"
#include "tests/support/catch.h"
#include "tests/support/synthetic_figure.h"

using namespace skel;

namespace {

// A figure of 40×80 px in a page of 100×100, and a house of 20×40 px grown onto its right.
struct Case {
  Plane8 figure = Plane8::Zero(100, 100), with_house = Plane8::Zero(100, 100);
  SeenPage seen;

  Case() {
    figure.block(10, 20, 80, 40).setConstant(255);
    with_house = figure;
    with_house.block(50, 60, 40, 20).setConstant(255);
    seen.share = (figure > 0).select(Plane8::Constant(100, 100, 240), Plane8::Constant(100, 100, 5));
  }
};

Silhouette found(const Plane8& mask, const SeenPage& seen) {
  Silhouette silhouette;
  silhouette.status = SilhouetteStatus::kFound;
  silhouette.mask = mask;
  silhouette.grid = gridOver(mask);
  silhouette.evidence = evidenceOfMask(mask, seen);
  return silhouette;
}

double input(const MaskEvidence& evidence, std::string_view name) {
  for (std::size_t i = 0; i < kMaskInputs.size(); ++i)
    if (kMaskInputs[i] == name) return evidence.inputs[static_cast<Eigen::Index>(i)];
  throw std::runtime_error("no such input");
}

}  // namespace

TEST_CASE("a mask where the net sees the figure has nothing against it") {
  const Case c;
  const MaskEvidence evidence = evidenceOfMask(c.figure, c.seen);
  CHECK(!evidence.doubtful);
  CHECK(input(evidence, "overlap") > .85);
  CHECK(input(evidence, "not seen") == Approx(-3));
  CHECK(input(evidence, "not taken") == Approx(-3));
  CHECK(input(evidence, "inside") == Approx(240 / 255.).margin(.01));
  CHECK(input(evidence, "around") == Approx(5 / 255.).margin(.01));
}

TEST_CASE("what the net does not see in a mask is measured and boxed, in px of a larger picture too") {
  const Case c;
  const MaskEvidence evidence = evidenceOfMask(c.with_house, c.seen);
  CHECK(input(evidence, "not seen") == Approx(std::log10(800. / 4000 + 1e-3)).margin(.03));
  CHECK(input(evidence, "largest not seen") == Approx(input(evidence, "not seen")).margin(.01));
  REQUIRE(evidence.doubtful);
  CHECK((*evidence.doubtful - Eigen::Array4d(60, 50, 20, 40)).abs().maxCoeff() <= 2);

  Plane8 twice(200, 200);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) twice(y, x) = c.with_house(y / 2, x / 2);
  const MaskEvidence of_twice = evidenceOfMask(twice, c.seen);
  CHECK((of_twice.inputs - evidence.inputs).cwiseAbs().maxCoeff() < .02);
  REQUIRE(of_twice.doubtful);
  CHECK((*of_twice.doubtful - 2 * *evidence.doubtful).abs().maxCoeff() <= 2);
}

TEST_CASE("a house grown onto the figure is named with its place, and a missing part as such") {
  // Sure of a mask unless the net misses a part of it, or sees more.
  SilhouetteConfidence confidence;
  const auto count = static_cast<Eigen::Index>(kMaskInputs.size());
  confidence.net.mean = confidence.net.direct = Eigen::VectorXd::Zero(count);
  confidence.net.deviation = Eigen::VectorXd::Ones(count);
  confidence.net.hidden.resize(0, count);
  for (Eigen::Index i = 0; i < count; ++i)
    if (kMaskInputs[std::size_t(i)] == "not seen" || kMaskInputs[std::size_t(i)] == "not taken")
      confidence.net.direct[i] = -2;
  confidence.net.bias = -9;

  const Case c;
  CHECK(!silhouetteDoubt(found(c.figure, c.seen), confidence));
  CHECK(silhouetteDoubt(found(c.with_house, c.seen), confidence).value_or("") ==
        "something may be stuck to the figure (lower right)");
  Plane8 missing = c.figure;
  missing.block(40, 20, 50, 40).setZero();
  CHECK(silhouetteDoubt(found(missing, c.seen), confidence).value_or("") ==
        "a part of the figure may be missing (lower part)");
  confidence.net.bias = -30;
  CHECK(silhouetteDoubt(found(c.figure, c.seen), confidence).value_or("") ==
        "the outline of the figure may be wrong");
}

TEST_CASE("the built-in numbers are surer of a figure that the net sees than of one with a house") {
  const CapsuleFigure capsules;
  const Plane8 figure = capsuleMask(capsules);
  Plane8 with_house = figure;
  with_house.block(250, 230, 120, 130).setConstant(255);
  SeenPage seen;
  seen.soft = true;
  seen.share = (figure > 0)
                   .select(Plane8::Constant(figure.rows(), figure.cols(), 245),
                           Plane8::Constant(figure.rows(), figure.cols(), 1));
  const SilhouetteConfidence& confidence = builtInSilhouetteConfidence();
  const double sure = confidence.of(evidenceOfMask(figure, seen)),
               less = confidence.of(evidenceOfMask(with_house, seen));
  CHECK(sure > .5);
  CHECK(less < .5);
}

TEST_CASE("what lines enclose was taken for the figure without a word where it may be ground") {
  Case c;
  Silhouette silhouette = found(c.figure, c.seen);
  silhouette.evidence.reset();
  Plane8 chance = Plane8::Zero(c.figure.rows() / 2, c.figure.cols() / 2);
  CHECK(!enclosedGround(c.figure, chance));
  chance.topLeftCorner(20, 8).setConstant(255);  // beside the figure
  CHECK(!enclosedGround(c.figure, chance));
  chance.block(20, 15, 9, 4).setConstant(204);
  silhouette.enclosed = enclosedGround(c.figure, chance);
  REQUIRE(silhouette.enclosed);
  CHECK(silhouette.enclosed->share == Approx(36 * .8 / 800).epsilon(.03));
  CHECK(!silhouetteDoubt(silhouette, builtInSilhouetteConfidence()));  // less than a twenty-fifth
  chance.block(20, 15, 20, 4).setConstant(204);
  silhouette.enclosed = enclosedGround(c.figure, chance);
  CHECK(silhouette.enclosed->share == Approx(80 * .8 / 800).epsilon(.03));
  CHECK((silhouette.enclosed->box - Eigen::Array4d(30, 40, 8, 40)).abs().maxCoeff() <= 2);
  CHECK_THAT(silhouetteDoubt(silhouette, builtInSilhouetteConfidence()).value_or(""),
             Catch::Matchers::StartsWith("what its lines enclose may be ground ("));
}

TEST_CASE("nothing is said of a silhouette for which the page net was not asked") {
  Case c;
  Silhouette silhouette = found(c.with_house, c.seen);
  silhouette.evidence.reset();
  CHECK(!silhouetteDoubt(silhouette, builtInSilhouetteConfidence()));
}

TEST_CASE(
    "the silhouette confidence read from its file is the one that was written, and others are refused") {
  const SilhouetteConfidence& built_in = builtInSilhouetteConfidence();
  const std::string text = formatSilhouetteConfidence(built_in);
  const SilhouetteConfidence again = parseSilhouetteConfidence(text, "s.json");
  CHECK(formatSilhouetteConfidence(again) == text);
  std::string other = text;
  other.replace(other.find("\"overlap\""), 9, "\"Overlap\"");
  CHECK_THROWS_AS(parseSilhouetteConfidence(other, "s.json"), InputError);
  CHECK_THROWS_AS(parseSilhouetteConfidence("{}", "s.json"), InputError);
}
