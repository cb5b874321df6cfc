#include "libskel/style/sparse_coding.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "libskel/core/error.h"
#include "libskel/core/rng.h"
#include "tests/support/catch.h"

using namespace skel;
using Catch::Matchers::Contains;
using Eigen::MatrixXd;

namespace {

struct Planted {
  MatrixXd basis, activations, data;
};

// Parts of which each pose uses few, as joints of different limbs.
Planted planted(int k, int m, double noise, std::uint64_t seed) {
  Rng rng(seed);
  Planted p{MatrixXd::Zero(34, k), MatrixXd::Zero(k, m), {}};
  for (int c = 0; c < k; ++c) {
    for (int r = 0; r < 34; ++r)
      if (r % k == c || rng.chance(0.15)) p.basis(r, c) = rng.uniform(0.2, 1);
    p.basis.col(c).normalize();
  }
  for (int i = 0; i < m; ++i)
    for (int c = 0; c < k; ++c)
      if (rng.chance(0.4) || i % k == c) p.activations(c, i) = rng.uniform(0.5, 2);
  p.data = p.basis * p.activations;
  for (double& x : p.data.reshaped()) x = std::max(0., x + noise * rng.normal());
  return p;
}

// The least over the planted parts of the best cosine with a found one.
double leastCosine(const MatrixXd& planted, const MatrixXd& found) {
  return (planted.transpose() * found).rowwise().maxCoeff().minCoeff();
}

}  // namespace

TEST_CASE("planted factors are found again, up to their order, in spite of noise") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    CAPTURE(seed);
    const Planted p = planted(4, 160, 0.02, seed);
    SparseCodingOptions options;
    options.components = 4;
    options.max_iterations = 3000;
    options.tolerance = 1e-9;
    const SparseCoding found = sparseCoding(p.data, options);
    CHECK(leastCosine(p.basis, found.basis) > 0.98);
    CHECK(found.error < 0.06);
  }
}

TEST_CASE("the objective never rises, and is what it says") {
  const Planted p = planted(5, 90, 0.1, 7);
  for (const double sparsity : {0., 0.01, 1.}) {
    SparseCodingOptions options;
    options.components = 6;
    options.sparsity = sparsity;
    options.max_iterations = 200;
    const SparseCoding found = sparseCoding(p.data, options);
    REQUIRE(found.objectives.size() > 10);
    for (std::size_t i = 1; i < found.objectives.size(); ++i)
      REQUIRE(found.objectives[i] <= found.objectives[i - 1]);
    const double direct =
        0.5 * (p.data - found.basis * found.activations).squaredNorm() + sparsity * found.activations.sum();
    CHECK(found.objectives.back() == Approx(direct).epsilon(1e-9));
    CHECK(found.objectives.back() < (sparsity < 1 ? 0.3 : 0.9) * found.objectives.front());
    CHECK(found.basis.minCoeff() >= 0);
    CHECK(found.activations.minCoeff() >= 0);
    for (int c = 0; c < 6; ++c) CHECK(found.basis.col(c).norm() == Approx(1));
  }
}

TEST_CASE("more sparsity, fewer activations") {
  const Planted p = planted(4, 80, 0.05, 5);
  const auto activity = [&](double sparsity) {
    SparseCodingOptions options;
    options.components = 4;
    options.sparsity = sparsity;
    return sparseCoding(p.data, options).activations.sum();
  };
  CHECK(activity(1) < 0.95 * activity(0));
}

TEST_CASE("the order of the frames does not matter") {
  const Planted p = planted(3, 60, 0.03, 11);
  MatrixXd shuffled(p.data.rows(), p.data.cols());
  for (int i = 0; i < 60; ++i) shuffled.col(i) = p.data.col(i * 7 % 60);
  SparseCodingOptions options;
  options.components = 3;
  const SparseCoding a = sparseCoding(p.data, options), b = sparseCoding(shuffled, options);
  CHECK((a.basis - b.basis).cwiseAbs().maxCoeff() < 1e-3);
  for (int i = 0; i < 60; ++i)
    CHECK((a.activations.col(i * 7 % 60) - b.activations.col(i)).cwiseAbs().maxCoeff() < 1e-2);
}

TEST_CASE("the same numbers every time") {
  const Planted p = planted(3, 40, 0.03, 3);
  CHECK(sparseCoding(p.data).basis == sparseCoding(p.data).basis);
}

TEST_CASE("one frame, equal frames and nothing but zeros give what one expects") {
  SparseCodingOptions options;
  options.components = 3;
  options.sparsity = 1e-4;
  const MatrixXd one = planted(3, 1, 0, 2).data;
  CHECK(sparseCoding(one, options).error < 0.01);
  const MatrixXd same = one.replicate(1, 12);
  const SparseCoding equal = sparseCoding(same, options);
  CHECK(equal.error < 0.01);
  CHECK((equal.activations.colwise() - equal.activations.col(0)).cwiseAbs().maxCoeff() < 1e-9);
  const SparseCoding zero = sparseCoding(MatrixXd::Zero(34, 5), options);
  CHECK(zero.error == 0);
  CHECK(zero.basis.allFinite());
  CHECK(zero.activations.allFinite());
}

TEST_CASE("what cannot be factorised is said") {
  CHECK_THROWS_WITH(sparseCoding(MatrixXd(34, 0)), Contains("no poses"));
  MatrixXd bad = MatrixXd::Ones(34, 4);
  bad(3, 2) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(sparseCoding(bad), Contains("no number"));
  bad(3, 2) = -1;
  CHECK_THROWS_WITH(sparseCoding(bad), Contains("negative"));
  SparseCodingOptions options;
  options.components = 0;
  CHECK_THROWS_AS(sparseCoding(MatrixXd::Ones(34, 4), options), UsageError);
}
