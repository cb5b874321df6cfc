#include "trainer/backprop.h"

#include "libskel/classifier/block_kernel.h"
#include "libskel/core/check.h"

namespace skel {
namespace {

// One layer of one block, as the inner loops want it.
template <class Scalar>
struct LayerPass {
  int inputs, outputs;
  const Scalar* weights;  // outputs × inputs, then biases
  const Scalar* input;
  Scalar* output;
  Scalar* delta;        // error of the layer's sums
  Scalar* delta_below;  // of the layer below, null for the first
  Scalar* sums;         // lanes for each parameter of the layer
};

template <class Scalar>
SKEL_INLINE void outputDelta(int outputs, const Scalar* output, const Scalar* target, const Scalar* weight,
                             Scalar* delta, Scalar* error_sums) {
  constexpr int kLanes = kLaneCount<Scalar>;
  auto sum = load<kLanes>(error_sums);
  for (int j = 0; j < outputs; ++j)
    for (int s = 0; s < kBlockSize; s += kLanes) {
      const int at = j * kBlockSize + s;
      const auto y = load<kLanes>(output + at);
      const auto difference = y - load<kLanes>(target + at);
      const auto weighted = load<kLanes>(weight + s) * difference;
      sum += weighted * difference;
      store(delta + at, weighted * (y * (1 - y)));
    }
  store(error_sums, sum);
}

template <class Scalar>
SKEL_INLINE void backward(const LayerPass<Scalar>& layer) {
  constexpr int kLanes = kLaneCount<Scalar>;
  for (int j = 0; j < layer.outputs; ++j) {
    const Scalar* delta = layer.delta + j * kBlockSize;
    for (int i = 0; i < layer.inputs; ++i) {
      const Scalar* input = layer.input + i * kBlockSize;
      Scalar* to = layer.sums + (i * layer.outputs + j) * kLanes;
      auto even = load<kLanes>(to);
      Lanes<Scalar, kLanes> odd = {};
#pragma GCC unroll 8
      for (int s = 0; s < kBlockSize; s += 2 * kLanes) {
        even += load<kLanes>(delta + s) * load<kLanes>(input + s);
        odd += load<kLanes>(delta + s + kLanes) * load<kLanes>(input + s + kLanes);
      }
      store(to, even + odd);
    }
    Scalar* to = layer.sums + (layer.inputs * layer.outputs + j) * kLanes;
    auto sum = load<kLanes>(to);
#pragma GCC unroll 8
    for (int s = 0; s < kBlockSize; s += kLanes) sum += load<kLanes>(delta + s);
    store(to, sum);
  }
  if (!layer.delta_below) return;
  for (int i = 0; i < layer.inputs; ++i)
    for (int s = 0; s < kBlockSize; s += kLanes) {
      Lanes<Scalar, kLanes> sum = {};
      for (int j = 0; j < layer.outputs; ++j)
        sum += layer.weights[i * layer.outputs + j] * load<kLanes>(layer.delta + j * kBlockSize + s);
      const auto y = load<kLanes>(layer.input + i * kBlockSize + s);
      store(layer.delta_below + i * kBlockSize + s, sum * (y * (1 - y)));
    }
}

template <class Scalar>
SKEL_INLINE void blockPass(const LayerPass<Scalar>* layers, int count, const Scalar* target,
                           const Scalar* weight, Scalar* error_sums, bool with_gradient) {
  for (int l = 0; l < count; ++l)
    forwardKernel(layers[l].inputs, layers[l].outputs, layers[l].weights,
                  layers[l].weights + layers[l].inputs * layers[l].outputs, layers[l].input,
                  layers[l].output);
  const LayerPass<Scalar>& last = layers[count - 1];
  outputDelta(last.outputs, last.output, target, weight, last.delta, error_sums);
  if (!with_gradient) return;
  for (int l = count - 1; l >= 0; --l) backward(layers[l]);
}

SKEL_WIDE void widePass(const LayerPass<float>* layers, int count, const float* target, const float* weight,
                        float* error_sums, bool with_gradient) {
  blockPass(layers, count, target, weight, error_sums, with_gradient);
}
SKEL_WIDE void widePass(const LayerPass<double>* layers, int count, const double* target,
                        const double* weight, double* error_sums, bool with_gradient) {
  blockPass(layers, count, target, weight, error_sums, with_gradient);
}

}  // namespace

template <class Scalar>
Backprop<Scalar>::Backprop(const std::vector<int>& sizes) {
  const Network<Scalar> network(sizes);
  for (int l = 0; l < network.layerCount(); ++l) {
    activations_.emplace_back(kBlockSize, network.outputs(l));
    deltas_.emplace_back(kBlockSize, network.outputs(l));
  }
  sums_.resize(kLaneCount<Scalar>, network.parameters.size() + 1);
}

template <class Scalar>
double Backprop<Scalar>::lossAndGradient(const Network<Scalar>& network, const SampleBlocks<Scalar>& samples,
                                         std::size_t first, std::size_t last, Vector& gradient) {
  const int count = network.layerCount();
  SKEL_CHECK_EQ(network.parameters.size() + 1, sums_.cols());
  std::vector<LayerPass<Scalar>> layers;
  for (int l = 0; l < count; ++l) {
    const auto index = static_cast<std::size_t>(l);
    layers.push_back({network.inputs(l), network.outputs(l), network.parameters.data() + network.offset(l),
                      l > 0 ? activations_[index - 1].data() : nullptr, activations_[index].data(),
                      deltas_[index].data(), l > 0 ? deltas_[index - 1].data() : nullptr,
                      sums_.col(network.offset(l)).data()});
  }
  sums_.setZero();
  Scalar* error_sums = sums_.col(sums_.cols() - 1).data();
  const bool with_gradient = gradient.size() > 0;
  Scalar weight = 0;
  for (std::size_t b = first; b < last; ++b) {
    layers[0].input = samples.inputs[b].data();
    widePass(layers.data(), count, samples.targets[b].data(), samples.weights[b].data(), error_sums,
             with_gradient);
  }
  if (first == 0 && last == samples.inputs.size())
    weight = static_cast<Scalar>(samples.total_weight);
  else
    for (std::size_t b = first; b < last; ++b)
      for (const Scalar w : samples.weights[b].reshaped()) weight += w;
  const Scalar scale = weight > 0 ? 1 / (weight * static_cast<Scalar>(network.sizes.back())) : 0;
  // Lane by lane: the order of the sum is fixed.
  Vector totals = Vector::Zero(sums_.cols());
  for (int lane = 0; lane < kLaneCount<Scalar>; ++lane) totals += sums_.row(lane).matrix().transpose();
  if (with_gradient) gradient = 2 * scale * totals.head(gradient.size());
  return static_cast<double>(scale * totals[totals.size() - 1]);
}

template <class Scalar>
double Backprop<Scalar>::loss(const Network<Scalar>& network, const SampleBlocks<Scalar>& samples) {
  Vector no_gradient;
  return lossAndGradient(network, samples, no_gradient);
}

template class Backprop<float>;
template class Backprop<double>;

}  // namespace skel
