// OpenCV's ANN_MLP on the same net and data.
#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>
#include <opencv2/ml.hpp>

#include "tests/support/benchmark_samples.h"

namespace {

using cv::ml::ANN_MLP;

cv::Mat matOf(const Eigen::MatrixXf& matrix) {
  cv::Mat mat(static_cast<int>(matrix.rows()), static_cast<int>(matrix.cols()), CV_32F);
  for (int r = 0; r < mat.rows; ++r)
    for (int c = 0; c < mat.cols; ++c) mat.at<float>(r, c) = matrix(r, c);
  return mat;
}

struct Data {
  skel::Samples samples = skel::benchmarkSamples();
  cv::Mat inputs = matOf(samples.inputs);
  // OpenCV's symmetric sigmoid ends near ±1.
  cv::Mat targets = matOf((samples.targets.array() * 1.8f - 0.9f).matrix());
  cv::Ptr<cv::ml::TrainData> training = cv::ml::TrainData::create(inputs, cv::ml::ROW_SAMPLE, targets);
};

cv::Ptr<ANN_MLP> net(int method, int passes) {
  cv::theRNG().state = 7;
  const auto mlp = ANN_MLP::create();
  mlp->setLayerSizes(cv::Mat(std::vector<int>{3, 4, 4, 2}));
  mlp->setActivationFunction(ANN_MLP::SIGMOID_SYM, 1, 1);
  mlp->setTrainMethod(method, 0.1, method == ANN_MLP::RPROP ? 1e-6 : 0.1);
  mlp->setTermCriteria({cv::TermCriteria::MAX_ITER, passes, 0});
  return mlp;
}

double mse(const ANN_MLP& mlp, const Data& data) {
  cv::Mat outputs;
  mlp.predict(data.inputs, outputs);
  // In the units of targets 0 and 1.
  const cv::Mat difference = (outputs - data.targets) / 1.8;
  return difference.dot(difference) / static_cast<double>(difference.total());
}

// s_per_pass: what one pass costs, in a training of so many.
void pass(benchmark::State& state, int method) {
  const Data data;
  const int passes = method == ANN_MLP::RPROP ? 200 : 10;
  const int flags = ANN_MLP::NO_INPUT_SCALE | ANN_MLP::NO_OUTPUT_SCALE;
  for (auto _ : state) net(method, passes)->train(data.training, flags);
  state.counters["s_per_pass"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * passes,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(pass, opencv_rprop, ANN_MLP::RPROP);
BENCHMARK_CAPTURE(pass, opencv_online, ANN_MLP::BACKPROP);

// The fewest passes that suffice are found first: only their training is timed.
void timeToMse(benchmark::State& state, int method) {
  const Data data;
  const int flags = ANN_MLP::NO_INPUT_SCALE | ANN_MLP::NO_OUTPUT_SCALE;
  int passes = 1;
  for (;; ++passes) {
    const auto mlp = net(method, passes);
    mlp->train(data.training, flags);
    if (mse(*mlp, data) <= 0.025 || passes > 500) break;
  }
  if (passes > 500) {
    state.SkipWithError("does not get there");
    return;
  }
  for (auto _ : state) net(method, passes)->train(data.training, flags);
  state.counters["passes"] = passes;
}
BENCHMARK_CAPTURE(timeToMse, opencv_rprop, ANN_MLP::RPROP);
BENCHMARK_CAPTURE(timeToMse, opencv_online, ANN_MLP::BACKPROP);

void inference(benchmark::State& state) {
  const Data data;
  const auto mlp = net(ANN_MLP::RPROP, 20);
  mlp->train(data.training, ANN_MLP::NO_INPUT_SCALE | ANN_MLP::NO_OUTPUT_SCALE);
  cv::Mat outputs;
  for (auto _ : state) benchmark::DoNotOptimize(mlp->predict(data.inputs, outputs));
  state.SetItemsProcessed(state.iterations() * data.inputs.rows);
}
BENCHMARK(inference)->Name("inference/opencv");

}  // namespace
