#include "libskel/classifier/features.h"

#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("features are normalised over all maxima of the image, kept or not") {
  CandidateSet candidates;
  candidates.maxima = {{10, 20, 8}, {30, 120, 4}, {20, 70, 2}};
  candidates.kept = {0};
  const Features rows = features(candidates);
  CHECK(rows.row(0) == Eigen::RowVector3f(0, 0, 1));
  CHECK(rows.row(1).isApprox(Eigen::RowVector3f(1, 1, 1.f / 3)));
  CHECK(rows.row(2).isApprox(Eigen::RowVector3f(0.5, 0.5, 0)));
}

TEST_CASE("a column without range is 0.5") {
  CandidateSet candidates;
  CHECK(features(candidates).rows() == 0);
  candidates.maxima = {{3, 4, 1}};
  CHECK(features(candidates).row(0) == Eigen::RowVector3f(0.5, 0.5, 0.5));
  candidates.maxima = {{3, 4, 1}, {5, 4, 1}};
  CHECK(features(candidates).row(1) == Eigen::RowVector3f(1, 0.5, 0.5));
}
