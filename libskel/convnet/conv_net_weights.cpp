// Weights of convolutional nets as bytes.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "libskel/convnet/conv_kernels_sets.h"
#include "libskel/convnet/conv_net.h"
#include "libskel/core/error.h"
#include "libskel/core/json.h"
#include "libskel/core/sha256.h"

namespace skel {
namespace {

static_assert(std::endian::native == std::endian::little, "weights are read and written as they lie");

std::size_t weightCount(const ConvLayer& layer) { return layer.biases - layer.weights; }

// visit(weight, output) for each weight of a layer, in their order: weightIndex(), read backwards.
template <typename Visit>
void forEachWeight(const ConvLayer& layer, const Visit& visit) {
  const std::size_t panel = weightCount(layer) / static_cast<std::size_t>(layer.channels) * kWeightPanel;
  for (std::size_t first = 0; first < weightCount(layer); first += kWeightPanel)
    for (std::size_t k = 0; k < kWeightPanel; ++k) visit(first + k, first / panel * kWeightPanel + k);
}

std::vector<float> outputScales(const ConvNet& net, const ConvLayer& layer) {
  std::vector<float> scales(layer.channels, 0.f);
  forEachWeight(layer, [&](std::size_t i, std::size_t output) {
    scales[output] = std::max(scales[output], std::abs(net.parameters[layer.weights + i]) / 127);
  });
  return scales;
}

std::int8_t rounded(float weight, float scale) {
  if (scale == 0) return 0;
  return static_cast<std::int8_t>(std::clamp(std::lround(weight / scale), -127l, 127l));
}

}  // namespace

std::vector<std::array<int, 3>> convolutionSizes(const ConvNet& net) {
  std::vector<std::array<int, 3>> list;
  for (const ConvLayer& layer : net.layers) {
    if (layer.kind != ConvLayer::Kind::kConvolution) continue;
    list.push_back({net.maps[layer.input].channels, layer.channels, layer.kernel});
  }
  return list;
}

void quantize(ConvNet& net) {
  net.transformed = nullptr;
  for (const ConvLayer& layer : net.layers) {
    if (layer.kind != ConvLayer::Kind::kConvolution) continue;
    const std::vector<float> scales = outputScales(net, layer);
    forEachWeight(layer, [&](std::size_t i, std::size_t output) {
      float& w = net.parameters[layer.weights + i];
      w = static_cast<float>(rounded(w, scales[output])) * scales[output];
    });
  }
}

std::string formatWeights(const ConvNet& net) {
  std::string bytes;
  const auto append = [&](const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  };
  for (const ConvLayer& layer : net.layers) {
    if (layer.kind != ConvLayer::Kind::kConvolution) continue;
    const std::vector<float> scales = outputScales(net, layer);
    append(scales.data(), scales.size() * sizeof(float));
    append(net.parameters.data() + layer.biases, layer.channels * sizeof(float));
    forEachWeight(layer, [&](std::size_t i, std::size_t output) {
      const std::int8_t w = rounded(net.parameters[layer.weights + i], scales[output]);
      append(&w, 1);
    });
  }
  return bytes;
}

void parseWeights(std::string_view bytes, const JsonValue& header, const std::string& file, ConvNet& net,
                  bool check_hash) {
  const auto expected = convolutionSizes(net);
  const std::vector<JsonValue> given = header.at("convolutions").items();
  bool same = given.size() == expected.size();
  for (std::size_t i = 0; same && i < given.size(); ++i) {
    const std::vector<double> sizes = given[i].asNumbers(3);
    same = std::equal(sizes.begin(), sizes.end(), expected[i].begin());
  }
  if (!same) header.at("convolutions").fail("not the layers of this program's net: train it anew");
  std::size_t size = 0;
  for (const ConvLayer& layer : net.layers) {
    if (layer.kind == ConvLayer::Kind::kConvolution) {
      size += weightCount(layer) + 2 * sizeof(float) * static_cast<std::size_t>(layer.channels);
    }
  }
  if (bytes.size() != size) {
    throw InputError(file, "has " + std::to_string(bytes.size()) + " bytes of weights, expected " +
                               std::to_string(size) + ": the file is cut off or damaged");
  }
  const char* at = bytes.data();
  const auto take = [&](void* to, std::size_t wanted) {
    std::memcpy(to, at, wanted);
    at += wanted;
  };
  for (const ConvLayer& layer : net.layers) {
    if (layer.kind != ConvLayer::Kind::kConvolution) continue;
    std::vector<float> scales(layer.channels);
    take(scales.data(), scales.size() * sizeof(float));
    float *weights = net.parameters.data() + layer.weights, *biases = net.parameters.data() + layer.biases;
    take(biases, layer.channels * sizeof(float));
    for (std::size_t output = 0; output < scales.size(); ++output)
      if (!std::isfinite(128 * scales[output]) || !std::isfinite(biases[output]))
        throw InputError(file, "holds weights that are no numbers");
    const char* bytes_of_layer = at;
    at += weightCount(layer);
    forEachWeight(layer, [&](std::size_t i, std::size_t output) {
      weights[i] = static_cast<float>(static_cast<std::int8_t>(bytes_of_layer[i])) * scales[output];
    });
  }
  if (check_hash && sha256(bytes) != header.at("sha256").asString())
    throw InputError(file, "its weights do not fit its sha256: the file is damaged");
}

}  // namespace skel
