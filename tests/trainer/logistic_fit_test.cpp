#include "trainer/logistic_fit.h"

#include <cmath>

#include "libskel/core/rng.h"
#include "libskel/recognition/calibration.h"
#include "tests/support/catch.h"
#include "trainer/confidence_samples.h"

namespace skel {
namespace {

struct Cases {
  Eigen::MatrixXd inputs;
  Eigen::VectorXd came_true, weights;
};

// Cases of which `chance` says how often they come true.
template <class Chance>
Cases cases(int count, std::uint64_t seed, const Chance& chance) {
  Rng rng(seed);
  Cases all{Eigen::MatrixXd(count, 3), Eigen::VectorXd(count), Eigen::VectorXd::Ones(count)};
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < 3; ++k) all.inputs(i, k) = 5 + 2 * rng.normal();
    all.came_true[i] = rng.chance(chance(all.inputs.row(i)));
  }
  return all;
}

std::vector<Forecast> forecasts(const LogisticNet& net, const Cases& cases) {
  std::vector<Forecast> all;
  for (Eigen::Index i = 0; i < cases.inputs.rows(); ++i)
    all.push_back(
        {1 / (1 + std::exp(-net.logOdds(cases.inputs.row(i).transpose()))), cases.came_true[i] == 1});
  return all;
}

TEST_CASE("chances that are logistic in the inputs are learned, and are what is said") {
  const auto chance = [](const auto& x) { return 1 / (1 + std::exp(-(x[0] - 5) - .5 * (x[1] - 6))); };
  const Cases learned = cases(3000, 1, chance), others = cases(3000, 2, chance);
  LogisticFitOptions options;
  options.hidden = 0;
  const LogisticNet net = fitLogisticNet(learned.inputs, learned.came_true, learned.weights, options);
  CHECK(calibrationError(forecasts(net, others)) < .04);
  CHECK(areaUnderRoc(forecasts(net, others)) > .85);
}

TEST_CASE("hidden units learn what no weighted sum of the inputs says") {
  const auto chance = [](const auto& x) { return (x[0] > 5) == (x[1] > 5) ? .95 : .05; };
  const Cases learned = cases(3000, 1, chance), others = cases(3000, 2, chance);
  LogisticFitOptions options;
  options.decay = 1e-5;
  const auto measure = [&](int hidden) {
    options.hidden = hidden;
    return areaUnderRoc(
        forecasts(fitLogisticNet(learned.inputs, learned.came_true, learned.weights, options), others));
  };
  CHECK(measure(0) < .6);
  CHECK(measure(6) > .85);
}

TEST_CASE("cases of weight 0 do not count, and inputs that are always the same do no harm") {
  const auto chance = [](const auto& x) { return x[0] > 5 ? 1. : 0.; };
  Cases learned = cases(800, 1, chance);
  learned.inputs.col(2).setConstant(7);
  const LogisticNet net = fitLogisticNet(learned.inputs, learned.came_true, learned.weights);
  Cases more = learned;
  more.inputs.conservativeResize(900, 3), more.came_true.conservativeResize(900),
      more.weights.conservativeResize(900);
  for (Eigen::Index i = 800; i < 900; ++i) {
    more.inputs.row(i) = learned.inputs.row(i - 800);
    more.came_true[i] = 1 - learned.came_true[i - 800];
    more.weights[i] = 0;
  }
  const LogisticNet other = fitLogisticNet(more.inputs, more.came_true, more.weights);
  CHECK(areaUnderRoc(forecasts(net, learned)) > .99);
  CHECK(areaUnderRoc(forecasts(other, learned)) > .99);
  CHECK(net.logOdds(learned.inputs.row(0).transpose()) ==
        fitLogisticNet(learned.inputs, learned.came_true, learned.weights)
            .logOdds(learned.inputs.row(0).transpose()));
}

}  // namespace
}  // namespace skel
