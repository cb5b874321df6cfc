#include "trainer/optimizer.h"

#include "tests/support/benchmark_samples.h"
#include "tests/support/catch.h"
#include "trainer/online_pass.h"
#include "trainer/training.h"

using namespace skel;

namespace {

struct Method {
  const char* name;
  TrainingMethod method;
  int batch;
  double momentum;
  int epochs;
};

const std::vector<Method> kMethods = {{"full batch", TrainingMethod::kGradient, 0, 0.9, 1000},
                                      {"mini batch", TrainingMethod::kGradient, 32, 0.9, 100},
                                      {"online", TrainingMethod::kGradient, 1, 0.5, 60},
                                      {"rprop", TrainingMethod::kRprop, 0, 0, 300},
                                      {"lbfgs", TrainingMethod::kLbfgs, 0, 0, 300}};

TrainingOptions optionsFor(const Method& method, int seed) {
  TrainingOptions options;
  options.method = method.method;
  options.optimizer.batch = method.batch;
  options.optimizer.momentum = method.momentum;
  options.epochs = method.epochs;
  options.seed = seed;
  return options;
}

const TrainingData& benchmarkData() {
  static const TrainingData data(benchmarkSamples());
  return data;
}

bool finite(const Mlp& mlp) {
  for (const MlpLayer& layer : mlp.layers)
    if (!layer.weights.allFinite() || !layer.biases.allFinite()) return false;
  return true;
}

}  // namespace

TEST_CASE("100 of 100 seeds converge with the default method") {
  int converged = 0;
  for (int seed = 1; seed <= 100; ++seed) {
    TrainingOptions options;
    options.epochs = 300;
    options.seed = seed;
    const Training training = trainOnce(benchmarkData(), nullptr, options, 0, {});
    converged += training.loss < 0.025 && accuracyOn(benchmarkData().samples, training.mlp) > 0.95;
  }
  CHECK(converged == 100);
}

TEST_CASE("every method learns the benchmark, and gives the same bits again") {
  for (const Method& method : kMethods) {
    INFO(method.name);
    // The best of three starts, as the tool would take it.
    double best = 0;
    for (int start = 0; start < 3; ++start)
      best = std::max(best,
                      accuracyOn(benchmarkData().samples,
                                 trainOnce(benchmarkData(), nullptr, optionsFor(method, 1), start, {}).mlp));
    CHECK(best > 0.96);
    TrainingOptions few = optionsFor(method, 3);
    few.epochs = 20;
    const Training a = trainOnce(benchmarkData(), nullptr, few, 0, {});
    const Training b = trainOnce(benchmarkData(), nullptr, few, 0, {});
    CHECK(a.training_curve == b.training_curve);
    for (std::size_t l = 0; l < a.mlp.layers.size(); ++l)
      CHECK(a.mlp.layers[l].weights == b.mlp.layers[l].weights);
  }
}

TEST_CASE("no option leads to NaN") {
  for (const Method& method : kMethods)
    for (const double rate : {0., 1e-6, 100.})
      for (const double momentum : {0., 0.999})
        for (const double decay : {0., 1.}) {
          INFO(method.name << " rate " << rate << " momentum " << momentum << " decay " << decay);
          TrainingOptions options = optionsFor(method, 2);
          options.epochs = method.batch == 1 || method.batch == 32 ? 5 : 60;
          options.optimizer.learning_rate = rate;
          options.optimizer.momentum = momentum;
          options.optimizer.weight_decay = decay;
          const Training training = trainOnce(benchmarkData(), nullptr, options, 0, {});
          CHECK(finite(training.mlp));
          for (const float loss : training.training_curve) CHECK(std::isfinite(loss));
        }
}

TEST_CASE("rprop stays finite and good over thousands of passes") {
  TrainingOptions options;
  options.epochs = 3000;
  for (int seed = 1; seed <= 3; ++seed) {
    options.seed = seed;
    const Training training = trainOnce(benchmarkData(), nullptr, options, 0, {});
    CHECK(finite(training.mlp));
    CHECK(training.training_curve.back() < 0.025f);
  }
}

TEST_CASE("samples that cannot be told apart do no harm") {
  Samples samples{Eigen::MatrixXf::Constant(5, 3, 0.5f), Eigen::MatrixXf::Zero(5, 2),
                  Eigen::VectorXf::Ones(5)};
  samples.targets(0, 0) = 1;
  const TrainingData data(samples);
  for (const Method& method : kMethods) {
    INFO(method.name);
    const Training training = trainOnce(data, nullptr, optionsFor(method, 1), 0, {});
    CHECK(finite(training.mlp));
    // The best there is: the mean, 1/5.
    CHECK(training.loss < 0.5 * (0.2 * 0.8) + 0.02);
  }
}

TEST_CASE("an online step follows the gradient of its sample, in any layers") {
  const std::vector<int> sizes =
      GENERATE(std::vector{3, 4, 4, 2}, std::vector{3, 2}, std::vector{3, 7, 5, 2});
  Rng rng(8);
  Network<float> network(sizes);
  randomize(network, rng);
  const Samples& all = benchmarkData().samples;
  const Samples one{all.inputs.topRows(1), all.targets.topRows(1), Eigen::VectorXf::Constant(1, 1.f)};
  Eigen::VectorXf gradient(network.parameters.size());
  const double loss =
      Backprop<float>(network.sizes).lossAndGradient(network, SampleBlocks<float>(one), gradient);
  const Eigen::VectorXf before = network.parameters;
  CHECK(OnlinePass(sizes, one, {0.25f, 0, 0}).run(network, {0}) == Approx(loss).epsilon(1e-5));
  CHECK((network.parameters - (before - 0.25f * gradient)).norm() < 1e-6f);
}

TEST_CASE("weight decay shrinks weights and spares biases") {
  const Eigen::VectorXf decay = decayOf({3, 2}, 0.5);
  CHECK(decay.head(6).isConstant(0.5f));
  CHECK(decay.tail(2).isZero(0));
  TrainingOptions options;
  const auto norm = [&](double weight_decay) {
    options.optimizer.weight_decay = weight_decay;
    const Mlp mlp = trainOnce(benchmarkData(), nullptr, options, 0, {}).mlp;
    return mlp.layers[1].weights.norm();
  };
  CHECK(norm(1e-4) < norm(0));
}
