#include "trainer/online_pass.h"

#include <algorithm>

#include "libskel/classifier/lanes.h"
#include "libskel/classifier/sigmoid.h"

namespace skel {
namespace {

constexpr int kLanes = 4;
using Vector = Lanes<float, kLanes>;

SKEL_INLINE void forward(OnlinePass::Layer& layer, const float* input) {
  const float* parameters = layer.parameters.data();
  for (int j = 0; j < layer.padded_outputs; j += kLanes) {
    const float* column = parameters + j;
    Vector even = load<kLanes>(column + layer.inputs * layer.padded_outputs), odd = {};
    for (int i = 0; i < layer.inputs; ++i, column += layer.padded_outputs)
      (i % 2 ? odd : even) += load<kLanes>(column) * input[i];
    store(layer.activations.data() + j, sigmoid(even + odd));
  }
}

// Error of the last layer's sums; the sum of the squared differences is returned.
SKEL_INLINE float outputError(OnlinePass::Layer& layer, const float* target, float scale) {
  Vector sum = {};
  for (int j = 0; j < layer.padded_outputs; j += kLanes) {
    const Vector y = load<kLanes>(layer.activations.data() + j);
    const Vector difference = y - load<kLanes>(target + j);
    sum += difference * difference;
    store(layer.deltas.data() + j, 2 * scale * difference * (y * (1 - y)));
  }
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

// The sums of four vectors.
SKEL_INLINE Vector sumsOf(Vector a, Vector b, Vector c, Vector d) {
  const Vector ab = Vector{a[0], b[0], a[1], b[1]} + Vector{a[2], b[2], a[3], b[3]};
  const Vector cd = Vector{c[0], d[0], c[1], d[1]} + Vector{c[2], d[2], c[3], d[3]};
  return Vector{ab[0], ab[1], cd[0], cd[1]} + Vector{ab[2], ab[3], cd[2], cd[3]};
}

SKEL_INLINE void errorBelow(const OnlinePass::Layer& layer, OnlinePass::Layer& below) {
  for (int first = 0; first < layer.inputs; first += kLanes) {
    Vector products[kLanes] = {};
    for (int i = first; i < std::min(first + kLanes, layer.inputs); ++i)
      for (int j = 0; j < layer.padded_outputs; j += kLanes)
        products[i - first] += load<kLanes>(layer.parameters.data() + i * layer.padded_outputs + j) *
                               load<kLanes>(layer.deltas.data() + j);
    const Vector y = load<kLanes>(below.activations.data() + first);
    store(below.deltas.data() + first,
          sumsOf(products[0], products[1], products[2], products[3]) * (y * (1 - y)));
  }
}

SKEL_INLINE void move(OnlinePass::Layer& layer, const float* input, const OnlineOptions& options) {
  const Vector limit = Vector{} + 1;
  for (int j = 0; j < layer.padded_outputs; j += kLanes) {
    Vector delta = load<kLanes>(layer.deltas.data() + j);
    delta = delta < limit ? delta : limit;
    delta = delta > -limit ? delta : -limit;
    const Vector step = -options.learning_rate * delta;
    float* parameters = layer.parameters.data() + j;
    float* moves = layer.moves.data() + j;
    for (int i = 0; i <= layer.inputs;
         ++i, parameters += layer.padded_outputs, moves += layer.padded_outputs) {
      const Vector gradient = i < layer.inputs ? step * input[i] : step;
      const Vector moved = options.momentum * load<kLanes>(moves) + gradient;
      store(moves, moved);
      store(parameters, load<kLanes>(parameters) + moved);
    }
  }
}

SKEL_WIDE double runWide(OnlinePass::Layer* layers, int count, const OnlinePass::Sample* samples,
                         std::size_t sample_count, const OnlineOptions& options) {
  double loss = 0;
  const float kept = 1 - 2 * options.learning_rate * options.weight_decay;
  const auto outputs = static_cast<float>(layers[count - 1].outputs);
  for (std::size_t s = 0; s < sample_count; ++s) {
    const OnlinePass::Sample& sample = samples[s];
    for (int l = 0; l < count; ++l)
      forward(layers[l], l > 0 ? layers[l - 1].activations.data() : sample.input);
    const float scale = sample.weight / outputs;
    loss += static_cast<double>(scale * outputError(layers[count - 1], sample.target, scale));
    for (int l = count - 1; l > 0; --l) {
      errorBelow(layers[l], layers[l - 1]);
      move(layers[l], layers[l - 1].activations.data(), options);
    }
    move(layers[0], sample.input, options);
    if (kept != 1)
      for (int l = 0; l < count; ++l)
        for (int i = 0; i < layers[l].inputs * layers[l].padded_outputs; ++i)
          layers[l].parameters[static_cast<std::size_t>(i)] *= kept;
  }
  return loss;
}

}  // namespace

OnlinePass::OnlinePass(const std::vector<int>& sizes, const Samples& samples, const OnlineOptions& options)
    : options_(options), inputs_(samples.inputs.transpose()), weights_(samples.weights) {
  const Network<float> network(sizes);
  for (int l = 0; l < network.layerCount(); ++l) {
    Layer layer;
    layer.inputs = network.inputs(l);
    layer.outputs = network.outputs(l);
    layer.padded_outputs = (layer.outputs + kLanes - 1) / kLanes * kLanes;
    const auto padded = static_cast<std::size_t>(layer.padded_outputs);
    layer.parameters.assign(padded * static_cast<std::size_t>(layer.inputs + 1), 0.f);
    layer.moves = layer.parameters;
    layer.activations.assign(padded, 0.f);
    layer.deltas.assign(padded, 0.f);
    layers_.push_back(std::move(layer));
  }
  // The outputs that fill up a vector have no weights, so that they are always 0.5: no error.
  targets_ = Eigen::MatrixXf::Constant(layers_.back().padded_outputs, samples.count(), 0.5f);
  targets_.topRows(samples.targets.cols()) = samples.targets.transpose();
}

double OnlinePass::run(Network<float>& network, const std::vector<Eigen::Index>& order) {
  samples_.clear();
  for (const Eigen::Index s : order)
    samples_.push_back({inputs_.col(s).data(), targets_.col(s).data(), weights_[s]});
  copyFrom(network);
  const double loss =
      runWide(layers_.data(), static_cast<int>(layers_.size()), samples_.data(), samples_.size(), options_);
  copyTo(network);
  return loss;
}

void OnlinePass::copyFrom(const Network<float>& network) {
  const float* from = network.parameters.data();
  for (Layer& layer : layers_)
    for (int i = 0; i <= layer.inputs; ++i, from += layer.outputs)
      std::copy_n(from, layer.outputs, layer.parameters.data() + i * layer.padded_outputs);
}

void OnlinePass::copyTo(Network<float>& network) const {
  float* to = network.parameters.data();
  for (const Layer& layer : layers_)
    for (int i = 0; i <= layer.inputs; ++i, to += layer.outputs)
      std::copy_n(layer.parameters.data() + i * layer.padded_outputs, layer.outputs, to);
}

}  // namespace skel
