#include "trainer/conv_net_backward.h"

namespace skel {
namespace {

// The derivative of the layer's output is complete: turn it into that of the sum before max(0, ·).
void undoRelu(const std::vector<float>& out, std::vector<float>& gradient) {
  for (std::size_t i = 0; i < out.size(); ++i) gradient[i] = out[i] > 0 ? gradient[i] : 0.f;
}

void undoConvolution(const ConvNet& net, const ConvLayer& layer, InstructionSet set,
                     const std::vector<float>& transposed, const ConvNetMaps& maps, std::vector<float>& out,
                     ConvNetGradient& gradient) {
  const ConvShape shape = convShape(net, layer);
  if (layer.skip >= 0) {
    std::vector<float>& skip = gradient.maps[layer.skip];
    for (std::size_t i = 0; i < out.size(); ++i) skip[i] += out[i];
  }
  float* bias = gradient.parameters.data() + layer.biases;
  for (std::size_t i = 0; i < out.size(); i += shape.out_channels) {
    for (int c = 0; c < shape.out_channels; ++c) bias[c] += out[i + c];
  }
  convolveWeightGradient(set, shape, maps.maps[layer.input].data(), out.data(),
                         gradient.parameters.data() + layer.weights);
  if (layer.input == 0) return;
  ConvShape back = shape;
  std::swap(back.in_channels, back.out_channels);
  float* to = gradient.maps[layer.input].data();
  convolve(set, back, out.data(), transposed.data() + layer.weights, nullptr, to, false, to);
}

// The derivative goes to the first of the largest of the four.
void undoPool(const MapShape& to, const std::vector<float>& in, const std::vector<float>& out,
              const std::vector<float>& out_gradient, std::vector<float>& in_gradient) {
  const int width_in = 2 * to.width, channels = to.channels, stride = paddedStride(width_in) * channels;
  for (int y = 0; y < to.height; ++y) {
    for (int x = 0; x < to.width; ++x) {
      const std::size_t a = static_cast<std::size_t>(paddedIndex(width_in, 2 * y, 2 * x)) * channels;
      const std::size_t o = static_cast<std::size_t>(paddedIndex(to.width, y, x)) * channels;
      const float* __restrict value = in.data() + a;
      const float* __restrict largest = out.data() + o;
      const float* __restrict from = out_gradient.data() + o;
      float* __restrict into = in_gradient.data() + a;
      // Without branches, so that it becomes vector code.
      for (int c = 0; c < channels; ++c) {
        float left = from[c];
        for (const int step : {0, channels, stride, stride + channels}) {
          const float given = value[step + c] == largest[c] ? left : 0.f;
          into[step + c] += given;
          left -= given;
        }
      }
    }
  }
}

void undoUpsampleAdd(const MapShape& to, const std::vector<float>& out_gradient,
                     std::vector<float>& in_gradient, std::vector<float>& skip_gradient) {
  const int channels = to.channels;
  for (int y = 0; y < to.height; ++y) {
    for (int x = 0; x < to.width; ++x) {
      const std::size_t a = static_cast<std::size_t>(paddedIndex(to.width / 2, y / 2, x / 2)) * channels;
      const std::size_t i = static_cast<std::size_t>(paddedIndex(to.width, y, x)) * channels;
      for (int c = 0; c < channels; ++c) {
        in_gradient[a + c] += out_gradient[i + c];
        skip_gradient[i + c] += out_gradient[i + c];
      }
    }
  }
}

}  // namespace

std::vector<float> transposedWeights(const ConvNet& net) {
  std::vector<float> transposed(net.parameters.size(), 0.f);
  for (const ConvLayer& layer : net.layers) {
    // The input's own derivative is never asked for.
    if (layer.kind != ConvLayer::Kind::kConvolution || layer.input == 0) continue;
    const ConvShape shape = convShape(net, layer);
    ConvShape back = shape;
    std::swap(back.in_channels, back.out_channels);
    const int taps = shape.taps();
    const float* from = net.parameters.data() + layer.weights;
    float* to = transposed.data() + layer.weights;
    for (int t = 0; t < taps; ++t) {
      for (int i = 0; i < shape.in_channels; ++i) {
        for (int o = 0; o < shape.out_channels; ++o) {
          to[weightIndex(back, taps - 1 - t, o, i)] = from[weightIndex(shape, t, i, o)];
        }
      }
    }
  }
  return transposed;
}

ConvNetGradient::ConvNetGradient(const ConvNet& net) : parameters(net.parameters.size(), 0.f) {
  for (const MapShape& shape : net.maps) maps.emplace_back(shape.paddedSize(), 0.f);
}

void backward(const ConvNet& net, InstructionSet set, const std::vector<float>& transposed,
              const ConvNetMaps& maps, ConvNetGradient& gradient) {
  for (std::size_t i = net.layers.size(); i-- > 0;) {
    const ConvLayer& layer = net.layers[i];
    std::vector<float>& out = gradient.maps[i + 1];
    switch (layer.kind) {
      case ConvLayer::Kind::kConvolution:
        if (layer.relu) undoRelu(maps.maps[i + 1], out);
        undoConvolution(net, layer, set, transposed, maps, out, gradient);
        break;
      case ConvLayer::Kind::kPool:
        undoPool(net.maps[i + 1], maps.maps[layer.input], maps.maps[i + 1], out, gradient.maps[layer.input]);
        break;
      case ConvLayer::Kind::kUpsampleAdd:
        undoUpsampleAdd(net.maps[i + 1], out, gradient.maps[layer.input], gradient.maps[layer.skip]);
        break;
    }
  }
}

}  // namespace skel
