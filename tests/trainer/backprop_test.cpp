#include "trainer/backprop.h"

#include "libskel/core/json.h"
#include "tests/support/catch.h"

using namespace skel;

namespace {

struct Case {
  std::vector<int> sizes;
  int samples;
};

Samples randomSamples(const Case& c, Rng& rng) {
  const auto random = [&] { return static_cast<float>(rng.uniform()); };
  Samples samples;
  samples.inputs = Eigen::MatrixXf::NullaryExpr(c.samples, c.sizes.front(), random);
  samples.targets = Eigen::MatrixXf::NullaryExpr(c.samples, c.sizes.back(), random).array().round();
  samples.weights = Eigen::VectorXf::NullaryExpr(c.samples, [&] { return random() + 0.5f; });
  return samples;
}

template <class Scalar>
Network<Scalar> randomNetwork(const std::vector<int>& sizes, Rng& rng) {
  Network<Scalar> network(sizes);
  for (Scalar& parameter : network.parameters) parameter = static_cast<Scalar>(rng.uniform(-2, 2));
  return network;
}

}  // namespace

TEST_CASE("the gradient is that of central differences") {
  const Case c = GENERATE(Case{{3, 4, 4, 2}, 200}, Case{{3, 4, 4, 2}, 1}, Case{{3, 4, 4, 2}, kBlockSize},
                          Case{{3, 2}, 65}, Case{{5, 7, 1}, 30}, Case{{3, 9, 3, 6, 2}, 100});
  Rng rng(11);
  const SampleBlocks<double> samples(randomSamples(c, rng));
  Network<double> network = randomNetwork<double>(c.sizes, rng);
  Backprop<double> backprop(c.sizes);
  Eigen::VectorXd gradient(network.parameters.size());
  const double loss = backprop.lossAndGradient(network, samples, gradient);
  CHECK(backprop.loss(network, samples) == loss);
  constexpr double kStep = 1e-5;
  for (Eigen::Index i = 0; i < gradient.size(); ++i) {
    const double value = network.parameters[i];
    network.parameters[i] = value + kStep;
    const double above = backprop.loss(network, samples);
    network.parameters[i] = value - kStep;
    const double below = backprop.loss(network, samples);
    network.parameters[i] = value;
    const double difference = (above - below) / (2 * kStep);
    CHECK(std::abs(gradient[i] - difference) <= 1e-6 * std::max(std::abs(difference), 1e-3));
  }
}

TEST_CASE("loss and gradient are those that NumPy gives") {
  const JsonDocument document =
      JsonDocument::readFile(std::string(SKEL_SOURCE_DIR) + "/tests/trainer/reference.json");
  const JsonValue root = document.root();
  const auto matrixAt = [&](const char* key) {
    const auto rows = root.at(key).items();
    Eigen::MatrixXf matrix(rows.size(), rows.front().asNumbers().size());
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const auto row = rows[r].asNumbers();
      for (std::size_t k = 0; k < row.size(); ++k)
        matrix(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(k)) = static_cast<float>(row[k]);
    }
    return matrix;
  };
  const auto vectorAt = [&](const char* key) {
    const auto numbers = root.at(key).asNumbers();
    return Eigen::VectorXd(
        Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size())));
  };
  const Samples samples{matrixAt("inputs"), matrixAt("targets"), vectorAt("weights").cast<float>()};
  Network<double> network({3, 4, 4, 2});
  network.parameters = vectorAt("parameters");
  const Eigen::VectorXd expected = vectorAt("gradient");
  REQUIRE(expected.size() == network.parameters.size());

  Eigen::VectorXd gradient(expected.size());
  const double loss =
      Backprop<double>(network.sizes).lossAndGradient(network, SampleBlocks<double>(samples), gradient);
  CHECK(loss == Approx(root.at("loss").asNumber()).epsilon(1e-13));
  CHECK((gradient - expected).norm() < 1e-13 * expected.norm());

  Network<float> single(network.sizes);
  single.parameters = network.parameters.cast<float>();
  Eigen::VectorXf single_gradient(expected.size());
  Backprop<float>(network.sizes).lossAndGradient(single, SampleBlocks<float>(samples), single_gradient);
  CHECK((single_gradient.cast<double>() - expected).norm() < 2e-6 * expected.norm());
}

TEST_CASE("blocks of samples add up, and samples without weight count for nothing") {
  Rng rng(4);
  const Case c{{3, 4, 4, 2}, 3 * kBlockSize};
  Samples samples = randomSamples(c, rng);
  const Network<double> network = randomNetwork<double>(c.sizes, rng);
  Backprop<double> backprop(c.sizes);
  const SampleBlocks<double> blocks(samples);
  Eigen::VectorXd whole(network.parameters.size()), part(whole), sum = Eigen::VectorXd::Zero(whole.size());
  backprop.lossAndGradient(network, blocks, whole);
  for (std::size_t b = 0; b < 3; ++b) {
    backprop.lossAndGradient(network, blocks, b, b + 1, part);
    sum += part * blocks.weights[b].sum() / blocks.total_weight;
  }
  CHECK((sum - whole).norm() < 1e-14);
  CHECK(backprop.lossAndGradient(network, blocks, 1, 1, part) == 0);
  CHECK(part.isZero(0));

  samples.weights.tail(kBlockSize).setZero();
  backprop.lossAndGradient(network, SampleBlocks<double>(samples), whole);
  backprop.lossAndGradient(network, blocks, 0, 2, part);
  CHECK((part - whole).norm() < 1e-14);
}
