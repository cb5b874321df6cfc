#include "trainer/joint_net_backward.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace skel {
namespace {

// The derivative of the layer's output is complete: turn it into that of the sum before max(0, ·).
void undoRelu(const std::vector<float>& out, std::vector<float>& gradient) {
  for (std::size_t i = 0; i < out.size(); ++i) gradient[i] = out[i] > 0 ? gradient[i] : 0.f;
}

void undoConvolution(const JointNet& net, const JointNetLayer& layer, InstructionSet set,
                     const std::vector<float>& transposed, const JointNetMaps& maps, std::vector<float>& out,
                     JointNetGradient& gradient) {
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

std::vector<float> transposedWeights(const JointNet& net) {
  std::vector<float> transposed(net.parameters.size(), 0.f);
  for (const JointNetLayer& layer : net.layers) {
    // The input's own derivative is never asked for.
    if (layer.kind != JointNetLayer::Kind::kConvolution || layer.input == 0) continue;
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

JointNetGradient::JointNetGradient(const JointNet& net) : parameters(net.parameters.size(), 0.f) {
  for (const MapShape& shape : net.maps) maps.emplace_back(shape.paddedSize(), 0.f);
}

void backward(const JointNet& net, InstructionSet set, const std::vector<float>& transposed,
              const JointNetMaps& maps, JointNetGradient& gradient) {
  for (std::size_t i = net.layers.size(); i-- > 0;) {
    const JointNetLayer& layer = net.layers[i];
    std::vector<float>& out = gradient.maps[i + 1];
    switch (layer.kind) {
      case JointNetLayer::Kind::kConvolution:
        if (layer.relu) undoRelu(maps.maps[i + 1], out);
        undoConvolution(net, layer, set, transposed, maps, out, gradient);
        break;
      case JointNetLayer::Kind::kPool:
        undoPool(net.maps[i + 1], maps.maps[layer.input], maps.maps[i + 1], out, gradient.maps[layer.input]);
        break;
      case JointNetLayer::Kind::kUpsampleAdd:
        undoUpsampleAdd(net.maps[i + 1], out, gradient.maps[layer.input], gradient.maps[layer.skip]);
        break;
    }
  }
}

JointTarget jointTarget(const Figure& figure, const FramePlacement& placement, const NetJoints& joints) {
  constexpr double kHiddenWeight = .6;  // of a covered joint
  constexpr double kAbsentWeight = .3;
  JointTarget target;
  target.whole = figure.whole;
  for (int j = 0; j < joints.count(); ++j) {
    const int from = placement.mirrored ? joints.mirrored[j] : j;
    target.joints.push_back({cellFromFrame(placement.frameFromGrid(figure.joints[from])),
                             !figure.whole          ? 0
                             : figure.absent[from]  ? kAbsentWeight
                             : figure.visible[from] ? 1
                                                    : kHiddenWeight,
                             static_cast<bool>(figure.absent[from])});
  }
  return target;
}

template <typename Scalar>
double jointLoss(const std::vector<Scalar>& heatmaps, const JointTarget& target, double scale,
                 std::vector<Scalar>* gradient) {
  constexpr int kSize = kHeatmapSize;
  const int count = static_cast<int>(target.joints.size()), figure_channel = count;
  const auto at = [channels = heatmapChannels(count)](int cell, int channel) {
    return static_cast<std::size_t>(paddedIndex(kSize, cell / kSize, cell % kSize)) * channels + channel;
  };
  double loss = 0;
  std::array<Scalar, kSize * kSize> p;
  for (int j = 0; j < count; ++j) {
    const JointTarget::Joint& joint = target.joints[j];
    if (joint.weight == 0) continue;
    Scalar highest = heatmaps[at(0, j)];
    for (int i = 0; i < kSize * kSize; ++i) highest = std::max(highest, heatmaps[at(i, j)]);
    Scalar sum = 0;
    for (int i = 0; i < kSize * kSize; ++i) sum += p[i] = std::exp(heatmaps[at(i, j)] - highest);

    std::array<double, kSize> gx, gy;
    double sum_x = 0, sum_y = 0;
    for (int k = 0; k < kSize; ++k) {
      const double dx = k - joint.cell.x(), dy = k - joint.cell.y();
      sum_x += gx[k] = std::exp(-dx * dx / (2 * kTargetVariance));
      sum_y += gy[k] = std::exp(-dy * dy / (2 * kTargetVariance));
    }
    // A joint outside the frame has no cell to point at.
    if (!joint.absent && sum_x * sum_y < .5) continue;
    const double weight = joint.weight / count;
    for (int i = 0; i < kSize * kSize; ++i) {
      const double wanted =
          joint.absent ? 1. / (kSize * kSize) : gx[i % kSize] * gy[i / kSize] / (sum_x * sum_y);
      if (wanted > 1e-9) loss -= weight * wanted * (heatmaps[at(i, j)] - highest - std::log(sum));
      if (gradient) (*gradient)[at(i, j)] += static_cast<Scalar>(scale * weight * (p[i] / sum - wanted));
    }
  }
  double logit = 0;
  for (int i = 0; i < kSize * kSize; ++i) logit += heatmaps[at(i, figure_channel)];
  logit /= kSize * kSize;
  const double probability = 1 / (1 + std::exp(-logit)), wanted = target.whole ? 1 : 0;
  // log(1 + e^x) without overflow.
  loss += kFigureWeight * (std::max(logit, 0.) + std::log1p(std::exp(-std::abs(logit))) - wanted * logit);
  if (gradient) {
    const double g = scale * kFigureWeight * (probability - wanted) / (kSize * kSize);
    for (int i = 0; i < kSize * kSize; ++i) (*gradient)[at(i, figure_channel)] += static_cast<Scalar>(g);
  }
  return loss;
}

template double jointLoss(const std::vector<float>&, const JointTarget&, double, std::vector<float>*);
template double jointLoss(const std::vector<double>&, const JointTarget&, double, std::vector<double>*);

}  // namespace skel
