#include "trainer/grown_net.h"

#include <algorithm>

#include "libskel/core/check.h"
#include "trainer/conv_net_trainer.h"

namespace skel {
namespace {

std::span<float> parametersOf(ConvNet& net, const ConvLayer& layer) {
  return std::span(net.parameters)
      .subspan(layer.weights, layer.biases - layer.weights + static_cast<std::size_t>(layer.channels));
}

void copyLayer(const ConvNet& from, const ConvLayer& source, ConvNet& to, const ConvLayer& target) {
  if (source.kind != ConvLayer::Kind::kConvolution) return;
  const std::span<float> parameters = parametersOf(to, target);
  std::copy_n(from.parameters.begin() + static_cast<std::ptrdiff_t>(source.weights), parameters.size(),
              parameters.begin());
}

}  // namespace

JointNet grown(const JointNet& net, int hourglasses, Rng& rng) {
  SKEL_CHECK(hourglasses >= net.hourglasses);
  JointNet out = makeJointNet(net.body_plan, net.joints, hourglasses, net.maps[0].channels);
  out.bones = net.bones;
  initialise(out, rng);
  const std::size_t kept = net.layers.size() - 1;
  for (std::size_t i = 0; i < kept; ++i) copyLayer(net, net.layers[i], out, out.layers[i]);
  copyLayer(net, net.layers.back(), out, out.layers.back());

  // What writes to the map that the hourglasses have in common: residuals at its resolution, and the
  // convolution that comes up from below.
  const int height = net.maps[net.maps.size() - 2].height;
  for (std::size_t i = kept; i + 1 < out.layers.size(); ++i) {
    const ConvLayer& layer = out.layers[i];
    if (out.maps[i + 1].height != height) continue;
    const ConvLayer& writes = layer.kind == ConvLayer::Kind::kUpsampleAdd
                                  ? out.layers[static_cast<std::size_t>(layer.input) - 1]
                                  : layer;
    std::ranges::fill(parametersOf(out, writes), 0.f);
  }
  return out;
}

}  // namespace skel
