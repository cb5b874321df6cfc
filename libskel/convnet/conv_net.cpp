#include "libskel/convnet/conv_net.h"

#include <algorithm>
#include <cmath>

#include "libskel/convnet/winograd.h"
#include "libskel/core/check.h"
#include "libskel/core/error.h"

namespace skel {
namespace {

bool suitsWinograd(const ConvNet& net, const ConvLayer& layer) {
  return layer.kind == ConvLayer::Kind::kConvolution && suitsWinograd(convShape(net, layer));
}

void runConvolution(const ConvNet& net, const ConvLayer& layer, InstructionSet set, ConvNetMaps& maps,
                    std::vector<float>& out) {
  const ConvShape shape = convShape(net, layer);
  const float *in = maps.maps[layer.input].data(), *bias = net.parameters.data() + layer.biases,
              *skip = layer.skip < 0 ? nullptr : maps.maps[layer.skip].data();
  if (net.transformed && suitsWinograd(shape))
    convolveWinograd(set, shape, in, net.transformed.get() + layer.transformed, bias, skip, layer.relu,
                     out.data(), maps.scratch);
  else
    convolve(set, shape, in, net.parameters.data() + layer.weights, bias, skip, layer.relu, out.data());
}

void runPool(const MapShape& to, const std::vector<float>& in, std::vector<float>& out) {
  const int width_in = 2 * to.width, channels = to.channels, stride = paddedStride(width_in) * channels;
  for (int y = 0; y < to.height; ++y) {
    for (int x = 0; x < to.width; ++x) {
      const float* a = in.data() + static_cast<std::size_t>(paddedIndex(width_in, 2 * y, 2 * x)) * channels;
      float* o = out.data() + static_cast<std::size_t>(paddedIndex(to.width, y, x)) * channels;
      for (int c = 0; c < channels; ++c) {
        o[c] = std::max(std::max(a[c], a[c + channels]), std::max(a[c + stride], a[c + stride + channels]));
      }
    }
  }
}

void runUpsampleAdd(const MapShape& to, const std::vector<float>& in, const std::vector<float>& skip,
                    std::vector<float>& out) {
  const int channels = to.channels;
  for (int y = 0; y < to.height; ++y) {
    for (int x = 0; x < to.width; ++x) {
      const float* a =
          in.data() + static_cast<std::size_t>(paddedIndex(to.width / 2, y / 2, x / 2)) * channels;
      const std::size_t i = static_cast<std::size_t>(paddedIndex(to.width, y, x)) * channels;
      for (int c = 0; c < channels; ++c) out[i + c] = a[c] + skip[i + c];
    }
  }
}

}  // namespace

int ConvNetBuilder::convolution(int input, int channels, int kernel, bool relu, int skip) {
  const MapShape in = net_.maps[input];
  ConvLayer layer{ConvLayer::Kind::kConvolution, input, skip, channels, kernel, relu};
  layer.weights = parameter_count_;
  layer.biases = layer.weights + static_cast<std::size_t>(kernel * kernel * in.channels * channels);
  parameter_count_ = layer.biases + static_cast<std::size_t>(channels);
  return add(layer, {in.height, in.width, channels});
}

int ConvNetBuilder::pool(int input) {
  const MapShape in = net_.maps[input];
  return add({ConvLayer::Kind::kPool, input, -1, in.channels}, {in.height / 2, in.width / 2, in.channels});
}

int ConvNetBuilder::upsampleAdd(int input, int skip) {
  const MapShape to = net_.maps[skip];
  SKEL_CHECK_EQ(net_.maps[input].channels, to.channels);
  return add({ConvLayer::Kind::kUpsampleAdd, input, skip, to.channels}, to);
}

int ConvNetBuilder::residuals(int map, int count) {
  for (int i = 0; i < count; ++i) map = convolution(map, net_.maps[map].channels, 3, true, map);
  return map;
}

ConvNet ConvNetBuilder::take() {
  net_.parameters.assign(parameter_count_, 0.f);
  return std::move(net_);
}

int ConvNetBuilder::add(const ConvLayer& layer, const MapShape& shape) {
  net_.layers.push_back(layer);
  net_.maps.push_back(shape);
  return static_cast<int>(net_.maps.size()) - 1;
}

int hourglass(ConvNetBuilder& b, int map, std::span<const int> widths, std::span<const int> down,
              std::span<const int> up) {
  SKEL_CHECK(down.size() + 1 == widths.size() && up.size() <= down.size());
  std::vector<int> scales = {map};
  for (std::size_t i = 0; i < down.size(); ++i)
    scales.push_back(b.residuals(b.convolution(b.pool(scales.back()), widths[i + 1], 3, true), down[i]));
  map = scales.back();
  for (std::size_t i = 0; i < up.size(); ++i) {
    const std::size_t to = down.size() - 1 - i;
    map = b.residuals(b.upsampleAdd(b.convolution(map, widths[to], 1, false), scales[to]), up[i]);
  }
  return map;
}

ConvShape convShape(const ConvNet& net, const ConvLayer& layer) {
  const MapShape& in = net.maps[layer.input];
  return {in.height, in.width, in.channels, layer.channels, layer.kernel};
}

void transformWeights(ConvNet& net) {
  std::size_t size = 0;
  for (ConvLayer& layer : net.layers) {
    if (!suitsWinograd(net, layer)) continue;
    layer.transformed = size;
    size += winogradWeightCount(convShape(net, layer));
  }
  const std::shared_ptr<float[]> transformed(new float[size]);
  for (const ConvLayer& layer : net.layers) {
    if (!suitsWinograd(net, layer)) continue;
    winogradWeights(convShape(net, layer), net.parameters.data() + layer.weights,
                    transformed.get() + layer.transformed);
  }
  net.transformed = transformed;
}

ConvNetMaps::ConvNetMaps(const ConvNet& net) {
  for (const MapShape& shape : net.maps) maps.emplace_back(shape.paddedSize(), 0.f);
}

void forward(const ConvNet& net, InstructionSet set, ConvNetMaps& maps) {
  for (std::size_t i = 0; i < net.layers.size(); ++i) {
    const ConvLayer& layer = net.layers[i];
    std::vector<float>& out = maps.maps[i + 1];
    switch (layer.kind) {
      case ConvLayer::Kind::kConvolution:
        runConvolution(net, layer, set, maps, out);
        break;
      case ConvLayer::Kind::kPool:
        runPool(net.maps[i + 1], maps.maps[layer.input], out);
        break;
      case ConvLayer::Kind::kUpsampleAdd:
        runUpsampleAdd(net.maps[i + 1], maps.maps[layer.input], maps.maps[layer.skip], out);
        break;
    }
  }
  // Who looks for the largest of them would find none.
  if (!std::all_of(maps.maps.back().begin(), maps.maps.back().end(),
                   [](float v) { return std::isfinite(v); }))
    throw Error(ExitCode::kInput, "a net's answer is no number: its weights are damaged; train it anew");
}

}  // namespace skel
