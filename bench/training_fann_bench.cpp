// FANN on the same net and data.
#include <benchmark/benchmark.h>
#include <floatfann.h>

#include <memory>

#include "tests/support/benchmark_samples.h"

namespace {

struct Free {
  void operator()(fann* net) const { fann_destroy(net); }
  void operator()(fann_train_data* data) const { fann_destroy_train(data); }
};
using Net = std::unique_ptr<fann, Free>;
using Data = std::unique_ptr<fann_train_data, Free>;

Data benchmarkData() {
  const skel::Samples samples = skel::benchmarkSamples();
  const auto count = static_cast<unsigned>(samples.count());
  Data data(fann_create_train(count, 3, 2));
  for (unsigned i = 0; i < count; ++i) {
    for (unsigned k = 0; k < 3; ++k) data->input[i][k] = samples.inputs(i, k);
    for (unsigned k = 0; k < 2; ++k) data->output[i][k] = samples.targets(i, k);
  }
  return data;
}

Net net(fann_train_enum method) {
  Net net(fann_create_standard(4, 3, 4, 4, 2));
  fann_set_activation_function_hidden(net.get(), FANN_SIGMOID);
  fann_set_activation_function_output(net.get(), FANN_SIGMOID);
  fann_set_training_algorithm(net.get(), method);
  fann_randomize_weights(net.get(), -1.5f, 1.5f);
  return net;
}

void pass(benchmark::State& state, fann_train_enum method) {
  const Data data = benchmarkData();
  const Net trained = net(method);
  for (auto _ : state) benchmark::DoNotOptimize(fann_train_epoch(trained.get(), data.get()));
}
BENCHMARK_CAPTURE(pass, fann_rprop, FANN_TRAIN_RPROP);
BENCHMARK_CAPTURE(pass, fann_online, FANN_TRAIN_INCREMENTAL);

void timeToMse(benchmark::State& state, fann_train_enum method) {
  const Data data = benchmarkData();
  int failed = 0;
  for (auto _ : state) {
    const Net trained = net(method);
    int passes = 0;
    while (fann_train_epoch(trained.get(), data.get()) > 0.025f && ++passes < 500) {
    }
    failed += passes == 500;
  }
  state.counters["failed"] = failed;
}
BENCHMARK_CAPTURE(timeToMse, fann_rprop, FANN_TRAIN_RPROP)->Iterations(30);
BENCHMARK_CAPTURE(timeToMse, fann_online, FANN_TRAIN_INCREMENTAL)->Iterations(30);

void inference(benchmark::State& state) {
  const Data data = benchmarkData();
  const Net trained = net(FANN_TRAIN_RPROP);
  for (auto _ : state)
    for (unsigned i = 0; i < data->num_data; ++i)
      benchmark::DoNotOptimize(fann_run(trained.get(), data->input[i]));
  state.SetItemsProcessed(state.iterations() * data->num_data);
}
BENCHMARK(inference)->Name("inference/fann");

}  // namespace
