#include "libskel/classifier/mlp.h"

#include <cmath>

#include "libskel/classifier/block.h"
#include "libskel/classifier/sigmoid.h"
#include "libskel/classifier/weights_file.h"
#include "libskel/core/rng.h"
#include "tests/support/catch.h"

using namespace skel;

namespace {

Eigen::MatrixXf randomSamples(int count, int columns) {
  Rng rng(5);
  return Eigen::MatrixXf::NullaryExpr(count, columns, [&] { return static_cast<float>(rng.uniform()); });
}

// The definition, one sample at a time, in double.
Eigen::VectorXd plainNet(const Mlp& mlp, const Eigen::VectorXf& sample) {
  Eigen::VectorXd values = sample.cast<double>();
  for (const MlpLayer& layer : mlp.layers) {
    const Eigen::VectorXd sums = layer.weights.cast<double>() * values + layer.biases.cast<double>();
    values = sums.unaryExpr([](double x) { return 1 / (1 + std::exp(-x)); });
  }
  return values;
}

}  // namespace

TEST_CASE("the sigmoid is exact to a few units in the last place and stays inside (0, 1)") {
  double worst_float = 0, worst_double = 0;
  for (double x = -15.9; x < 15.9; x += 0.00137) {
    const double exact = 1 / (1 + std::exp(-x));
    const float xf = static_cast<float>(x);
    const double exact_float = 1 / (1 + std::exp(-double{xf}));
    worst_float = std::max(worst_float, std::abs(sigmoid(xf) - exact_float) / exact_float);
    worst_double = std::max(worst_double, std::abs(sigmoid(x) - exact) / exact);
  }
  CHECK(worst_float < 4e-7);
  CHECK(worst_double < 1e-15);
  for (const float x : {-1e30f, -100.f, 0.f, 100.f, 1e30f}) {
    CHECK(sigmoid(x) > 0);
    CHECK(sigmoid(x) < 1);
    CHECK(sigmoid(double{x}) > 0);
    CHECK(sigmoid(double{x}) < 1);
  }
  CHECK(sigmoid(0.f) == 0.5f);
}

TEST_CASE("the net gives what its definition says, for every number of samples") {
  const Mlp& mlp = defaultMlp();
  CHECK(mlp.sizes() == std::vector<int>{3, 4, 4, 2});
  for (const int count : {0, 1, 2, kBlockSize - 1, kBlockSize, kBlockSize + 1, 1000}) {
    const Eigen::MatrixXf samples = randomSamples(count, 3);
    const Eigen::MatrixXf outputs = evaluate(mlp, samples);
    REQUIRE(outputs.rows() == count);
    REQUIRE(outputs.cols() == 2);
    for (int i = 0; i < count; ++i) {
      CHECK((outputs.row(i).transpose().cast<double>() - plainNet(mlp, samples.row(i))).norm() < 2e-5);
      // A sample's bits do not depend on its neighbours.
      CHECK(evaluate(mlp, samples.row(i)) == outputs.row(i));
    }
  }
}

TEST_CASE("other layer sizes are computed as well") {
  for (const std::vector<int>& sizes : {std::vector{1, 1}, {5, 9, 1}, {3, 17, 2, 6, 4}}) {
    Rng rng(3);
    Mlp mlp;
    for (std::size_t l = 0; l + 1 < sizes.size(); ++l) {
      const auto random = [&] { return static_cast<float>(rng.uniform(-2, 2)); };
      mlp.layers.push_back({Eigen::MatrixXf::NullaryExpr(sizes[l + 1], sizes[l], random),
                            Eigen::VectorXf::NullaryExpr(sizes[l + 1], random)});
    }
    CHECK(mlp.sizes() == sizes);
    const Eigen::MatrixXf samples = randomSamples(70, sizes.front());
    const Eigen::MatrixXf outputs = evaluate(mlp, samples);
    for (int i = 0; i < samples.rows(); ++i)
      CHECK((outputs.row(i).transpose().cast<double>() - plainNet(mlp, samples.row(i))).norm() < 1e-5);
  }
}

TEST_CASE("class probabilities are the products of the bits' and sum to 1") {
  const Features samples = randomSamples(300, 3);
  const ClassProbabilities classes = classify(defaultMlp(), samples);
  const Eigen::MatrixXf bits = evaluate(defaultMlp(), samples);
  for (int i = 0; i < samples.rows(); ++i) {
    CHECK(classes.row(i).sum() == Approx(1).epsilon(1e-5));
    CHECK(classes(i, static_cast<int>(JointClass::kHand)) == Approx(bits(i, 0) * (1 - bits(i, 1))));
    CHECK(classes(i, static_cast<int>(JointClass::kBody)) == Approx((1 - bits(i, 0)) * bits(i, 1)));
  }
  CHECK(classify(defaultMlp(), Features(0, 3)).rows() == 0);
}
