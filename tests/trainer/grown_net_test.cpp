#include "trainer/grown_net.h"

#include <algorithm>
#include <array>

#include "libskel/core/files.h"
#include "tests/support/catch.h"

namespace skel {
namespace {

std::vector<float> heatmaps(const JointNet& net) {
  ConvNetMaps maps(net);
  Plane8 mask = Plane8::Zero(128, 60);
  mask.block(0, 10, 128, 30) = 255;
  encodeJointNetInput(mask, {}, FramePlacement::centred(mask), net.maps[0].channels, maps.maps[0]);
  forward(net, InstructionSet::kBaseline, maps);
  return maps.maps.back();
}

TEST_CASE("A grown net says what the smaller one says, until it learns") {
  const std::string file = SKEL_DATASETS "/../weights/archive/joint-net-pass-1.bin";
  const JointNet net = parseJointNet(readFile(file), file);
  Rng rng(1);
  const JointNet larger = grown(net, 3, rng), same = grown(net, 1, rng);
  CHECK(larger.hourglasses == 3);
  CHECK(larger.parameters.size() > 2 * net.parameters.size());
  CHECK(heatmaps(larger) == heatmaps(net));
  CHECK(same.parameters == net.parameters);

  const JointNet again = parseJointNet(formatJointNet(larger), "larger.bin");
  CHECK(again.hourglasses == 3);
  CHECK(again.parameters.size() == larger.parameters.size());

  // What is new can learn: of each hourglass the last layers wait for a gradient, those before them for
  // these.
  const auto is_zero = [&](const ConvLayer& layer) {
    return std::all_of(larger.parameters.begin() + static_cast<std::ptrdiff_t>(layer.weights),
                       larger.parameters.begin() + static_cast<std::ptrdiff_t>(layer.biases),
                       [](float w) { return w == 0; });
  };
  std::array<int, 2> zero{};  // at the heatmaps' resolution and below it
  for (const ConvLayer& layer : larger.layers)
    if (layer.kind == ConvLayer::Kind::kConvolution)
      zero[larger.maps[static_cast<std::size_t>(layer.input)].height == kHeatmapSize ? 0 : 1] +=
          is_zero(layer);
  CHECK(zero == std::array<int, 2>{4, 2});
}

}  // namespace
}  // namespace skel
