#include "libskel/convnet/conv_kernels.h"

#include <cmath>

#include "libskel/convnet/winograd.h"
#include "libskel/core/rng.h"
#include "tests/support/catch.h"

namespace skel {
namespace {

std::vector<float> randomMap(Rng& rng, int height, int width, int channels) {
  std::vector<float> map(static_cast<std::size_t>(paddedPixels(height, width)) * channels, 0.f);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < channels; ++c) {
        map[static_cast<std::size_t>(paddedIndex(width, y, x)) * channels + c] =
            static_cast<float>(rng.normal());
      }
    }
  }
  return map;
}

// By the definition, in double.
double reference(const ConvShape& s, const std::vector<float>& in, const std::vector<float>& weights, int y,
                 int x, int channel) {
  double sum = 0;
  const int half = s.kernel / 2;
  for (int dy = -half; dy <= half; ++dy) {
    for (int dx = -half; dx <= half; ++dx) {
      if (y + dy < 0 || x + dx < 0 || y + dy >= s.height || x + dx >= s.width) continue;
      const int tap = (dy + half) * s.kernel + dx + half;
      for (int c = 0; c < s.in_channels; ++c) {
        sum += static_cast<double>(
                   in[static_cast<std::size_t>(paddedIndex(s.width, y + dy, x + dx)) * s.in_channels + c]) *
               weights[weightIndex(s, tap, c, channel)];
      }
    }
  }
  return sum;
}

const ConvShape kShapes[] = {{7, 5, 8, 16, 3},   {9, 9, 32, 64, 3}, {1, 1, 8, 16, 3},
                             {6, 13, 16, 32, 1}, {2, 3, 24, 48, 3}, {4, 4, 8, 96, 1}};

TEST_CASE("Every instruction set convolves as the definition does") {
  const ConvShape shape = GENERATE(from_range(std::begin(kShapes), std::end(kShapes)));
  Rng rng(1);
  const std::vector<float> in = randomMap(rng, shape.height, shape.width, shape.in_channels);
  const std::vector<float> skip = randomMap(rng, shape.height, shape.width, shape.out_channels);
  std::vector<float> weights(shape.weights()), bias(shape.out_channels);
  for (float& w : weights) w = static_cast<float>(.2 * rng.normal());
  for (float& b : bias) b = static_cast<float>(rng.normal());
  for (const InstructionSet set : kInstructionSets) {
    if (!hasInstructionSet(set)) continue;
    for (const bool relu : {false, true}) {
      std::vector<float> out(skip.size(), 99.f);
      convolve(set, shape, in.data(), weights.data(), bias.data(), skip.data(), relu, out.data());
      double worst = 0, padding = 0;
      for (const float v : out) padding += std::abs(v);
      for (int y = 0; y < shape.height; ++y) {
        for (int x = 0; x < shape.width; ++x) {
          for (int c = 0; c < shape.out_channels; ++c) {
            const std::size_t i =
                static_cast<std::size_t>(paddedIndex(shape.width, y, x)) * shape.out_channels + c;
            double wanted = reference(shape, in, weights, y, x, c) + bias[c] + skip[i];
            if (relu) wanted = std::max(wanted, 0.);
            worst = std::max(worst, std::abs(out[i] - wanted));
            padding -= std::abs(out[i]);
          }
        }
      }
      INFO(instructionSetName(set) << " relu " << relu);
      CHECK(worst < 1e-4);
      CHECK(std::abs(padding) < 1e-2);
    }
  }
}

TEST_CASE("Winograd's convolution is the plain one but for rounding") {
  const ConvShape shape =
      GENERATE(ConvShape{7, 5, 16, 16, 3}, ConvShape{9, 9, 32, 64, 3}, ConvShape{1, 1, 16, 16, 3},
               ConvShape{18, 18, 96, 48, 3}, ConvShape{72, 70, 32, 32, 3}, ConvShape{2, 9, 48, 16, 3});
  REQUIRE(suitsWinograd(shape));
  Rng rng(5);
  const std::vector<float> in = randomMap(rng, shape.height, shape.width, shape.in_channels);
  const std::vector<float> skip = randomMap(rng, shape.height, shape.width, shape.out_channels);
  std::vector<float> weights(shape.weights()), bias(shape.out_channels);
  for (float& w : weights) w = static_cast<float>(.2 * rng.normal());
  for (float& b : bias) b = static_cast<float>(rng.normal());
  std::vector<float> transformed(winogradWeightCount(shape)), scratch;
  winogradWeights(shape, weights.data(), transformed.data());
  for (const InstructionSet set : kInstructionSets) {
    if (!hasInstructionSet(set)) continue;
    for (const bool relu : {false, true}) {
      std::vector<float> wanted(skip.size(), 99.f), out(skip.size(), 99.f);
      convolve(set, shape, in.data(), weights.data(), bias.data(), skip.data(), relu, wanted.data());
      convolveWinograd(set, shape, in.data(), transformed.data(), bias.data(), skip.data(), relu, out.data(),
                       scratch);
      float worst = 0;
      for (std::size_t i = 0; i < out.size(); ++i) worst = std::max(worst, std::abs(out[i] - wanted[i]));
      INFO(instructionSetName(set) << " relu " << relu);
      CHECK(worst < 1e-4);
    }
  }
}

// out is linear in the weights, so its derivative is exact: <out(w), g> = <w, gradient> for any w.
TEST_CASE("Every instruction set has the weights' derivative") {
  const ConvShape shape = GENERATE(from_range(std::begin(kShapes), std::end(kShapes)));
  Rng rng(2);
  const std::vector<float> in = randomMap(rng, shape.height, shape.width, shape.in_channels);
  const std::vector<float> g = randomMap(rng, shape.height, shape.width, shape.out_channels);
  std::vector<float> weights(shape.weights());
  for (float& w : weights) w = static_cast<float>(rng.normal());
  for (const InstructionSet set : kInstructionSets) {
    if (!hasInstructionSet(set)) continue;
    std::vector<float> out(g.size()), gradient(weights.size(), 0.f);
    convolve(set, shape, in.data(), weights.data(), nullptr, nullptr, false, out.data());
    convolveWeightGradient(set, shape, in.data(), g.data(), gradient.data());
    double a = 0, b = 0, size = 0;
    for (std::size_t i = 0; i < out.size(); ++i)
      a += static_cast<double>(out[i]) * g[i], size += std::abs(out[i] * g[i]);
    for (std::size_t i = 0; i < weights.size(); ++i) b += static_cast<double>(weights[i]) * gradient[i];
    INFO(instructionSetName(set));
    CHECK(std::abs(a - b) < 1e-6 * size);
  }
}

TEST_CASE("The best instruction set is one that the machine has") {
  CHECK(hasInstructionSet(InstructionSet::kBaseline));
  CHECK(hasInstructionSet(bestInstructionSet()));
}

}  // namespace
}  // namespace skel
