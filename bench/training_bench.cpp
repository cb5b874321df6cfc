// A 3-4-4-2 net on the fixed benchmark data (2,124 samples): a pass over them, the time until the mean
// squared error is 0.025, and inference. The same of OpenCV and FANN stand in the files beside this one.
#include <benchmark/benchmark.h>

#include "libskel/classifier/weights_file.h"
#include "tests/support/benchmark_samples.h"
#include "trainer/optimizer.h"

namespace skel {
namespace {

constexpr double kGoalMse = 0.025;

struct Start {
  explicit Start(std::uint64_t seed) : network({3, 4, 4, 2}) {
    Rng rng(seed);
    randomize(network, rng);
  }
  Network<float> network;
};

struct Method {
  TrainingMethod method;
  int batch;
  double momentum;

  std::unique_ptr<Optimizer> on(const TrainingData& data, const std::vector<int>& sizes) const {
    OptimizerOptions options;
    options.batch = batch;
    options.momentum = momentum;
    return makeOptimizer(method, data, sizes, options);
  }
};
constexpr Method kRprop{TrainingMethod::kRprop, 0, 0}, kOnline{TrainingMethod::kGradient, 1, 0.5},
    kMiniBatch{TrainingMethod::kGradient, 64, 0.9};

void pass(benchmark::State& state, const Method& method) {
  const TrainingData data(benchmarkSamples());
  Start start(1);
  const auto optimizer = method.on(data, start.network.sizes);
  for (auto _ : state) benchmark::DoNotOptimize(optimizer->pass(start.network));
}
BENCHMARK_CAPTURE(pass, skel_rprop, kRprop);
BENCHMARK_CAPTURE(pass, skel_online, kOnline);

void timeToMse(benchmark::State& state, const Method& method) {
  const TrainingData data(benchmarkSamples());
  std::uint64_t seed = 0;
  for (auto _ : state) {
    Start start(++seed);
    const auto optimizer = method.on(data, start.network.sizes);
    int passes = 0;
    while (optimizer->pass(start.network) > kGoalMse)
      if (++passes > 3000) {
        state.SkipWithError("does not get there");
        return;
      }
  }
}
BENCHMARK_CAPTURE(timeToMse, skel_rprop, kRprop)->Iterations(100);
BENCHMARK_CAPTURE(timeToMse, skel_online, kOnline)->Iterations(100);
BENCHMARK_CAPTURE(timeToMse, skel_batches_of_64, kMiniBatch)->Iterations(100);

void inference(benchmark::State& state) {
  const Samples samples = benchmarkSamples();
  for (auto _ : state) benchmark::DoNotOptimize(evaluate(defaultMlp(), samples.inputs));
  state.SetItemsProcessed(state.iterations() * samples.count());
}
BENCHMARK(inference)->Name("inference/skel");

}  // namespace
}  // namespace skel

BENCHMARK_MAIN();
