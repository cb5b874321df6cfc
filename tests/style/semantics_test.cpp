#include "libskel/style/semantics.h"

#include "libskel/core/error.h"
#include "libskel/core/rng.h"
#include "tests/support/catch.h"

using namespace skel;
using Eigen::MatrixXd;

namespace {

// Each class has a component of its own.
MatrixXd activationsOf(const std::vector<std::string>& actions, const std::vector<std::string>& classes) {
  Rng rng(4);
  MatrixXd v(Eigen::Index(classes.size()), Eigen::Index(actions.size()));
  for (Eigen::Index i = 0; i < v.cols(); ++i)
    for (Eigen::Index c = 0; c < v.rows(); ++c)
      v(c, i) = (actions[std::size_t(i)] == classes[std::size_t(c)] ? 1 : 0) + 0.1 * rng.uniform();
  return v;
}

}  // namespace

TEST_CASE("classes are read from the components that they use") {
  const std::vector<std::string> classes = {"jump", "run", "walk"};
  std::vector<std::string> actions;
  for (int i = 0; i < 60; ++i) actions.push_back(classes[std::size_t(i % 3)]);
  const MatrixXd v = activationsOf(actions, classes);
  const Semantics found = fitSemantics(v, actions);
  CHECK(found.classes == classes);
  CHECK(found.accuracy == 1);
  CHECK(found.class_weights.rows() == 3);
  CHECK(found.class_weights.cols() == 3);
  CHECK(found.residual < 3);
  for (int c = 0; c < 3; ++c) {
    Eigen::Index best;
    found.class_weights.col(c).maxCoeff(&best);
    CHECK(best == c);
  }
}

TEST_CASE("classes that share all components cannot be told apart, and that is said") {
  std::vector<std::string> actions;
  for (int i = 0; i < 40; ++i) actions.push_back(i % 2 ? "walk" : "run");
  CHECK(fitSemantics(MatrixXd::Ones(2, 40), actions).accuracy == 0.5);
}

TEST_CASE("one class is always right, a frame without one is refused") {
  CHECK(fitSemantics(MatrixXd::Ones(3, 4), {"walk", "walk", "walk", "walk"}).accuracy == 1);
  CHECK_THROWS_AS(fitSemantics(MatrixXd::Ones(3, 2), {"walk", ""}), UsageError);
  CHECK_THROWS_AS(fitSemantics(MatrixXd(3, 0), {}), UsageError);
  CHECK(fitSemantics(MatrixXd::Zero(3, 2), {"walk", "run"}).class_weights.allFinite());
}

TEST_CASE("components are matched by their signatures") {
  Rng rng(9);
  MatrixXd ours(5, 6);
  for (double& x : ours.reshaped()) x = rng.normal();
  const std::vector<int> order = {3, 0, 5, 1, 4, 2};
  MatrixXd theirs(5, 6);
  for (int c = 0; c < 6; ++c) theirs.col(order[std::size_t(c)]) = ours.col(c).array() + 0.05 * rng.normal();
  CHECK(matchSignatures(ours, theirs) == order);
  // The nearest of each alone would take the second column twice.
  const MatrixXd a = (MatrixXd(1, 2) << 1, 1.1).finished(), b = (MatrixXd(1, 2) << 5, 1).finished();
  CHECK(matchSignatures(a, b) == std::vector<int>{1, 0});
}
