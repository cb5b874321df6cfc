#include "libskel/jointnet/joint_net.h"

#include <cmath>

#include "libskel/core/error.h"
#include "libskel/core/rng.h"
#include "tests/support/catch.h"

namespace skel {
namespace {

JointNet randomNet() {
  JointNet net = makeJointNet();
  Rng rng(1);
  for (const JointNetLayer& layer : net.layers) {
    if (layer.kind != JointNetLayer::Kind::kConvolution) continue;
    const ConvShape shape = convShape(net, layer);
    const double size = std::sqrt(1. / (shape.taps() * shape.in_channels));
    for (std::size_t k = layer.weights; k < layer.biases; ++k)
      net.parameters[k] = static_cast<float>(size * rng.normal());
  }
  net.provenance = "random";
  return net;
}

std::string complaint(const std::string& bytes) {
  try {
    parseJointNet(bytes, "net.bin");
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST_CASE("A weights file gives back the rounded net") {
  const JointNet net = randomNet();
  const std::string bytes = formatJointNet(net);
  CHECK(bytes.size() < 1'500'000);
  const JointNet read = parseJointNet(bytes, "net.bin");
  CHECK(read.parameters == quantized(net).parameters);
  CHECK(read.provenance == "random");
  // Rounding twice changes nothing.
  CHECK(formatJointNet(read) == bytes);
  double worst = 0;
  for (std::size_t i = 0; i < net.parameters.size(); ++i) {
    worst = std::max(worst, std::abs(static_cast<double>(net.parameters[i]) - read.parameters[i]));
  }
  CHECK(worst > 0);
  CHECK(worst < .01);
}

TEST_CASE("Damaged weights files are refused with a reason") {
  using Catch::Matchers::Contains;
  const std::string bytes = formatJointNet(randomNet());
  CHECK_THAT(complaint(""), Contains("net.bin") && Contains("no header"));
  CHECK_THAT(complaint("{}\n"), Contains("format"));
  CHECK_THAT(complaint(bytes.substr(0, bytes.size() - 1)), Contains("cut off or damaged"));
  std::string flipped = bytes;
  flipped.back() = static_cast<char>(flipped.back() ^ 1);
  CHECK_THAT(complaint(flipped), Contains("sha256"));
  std::string joints = bytes;
  joints.replace(joints.find("left_knee"), 9, "left_kneo");
  CHECK_THAT(complaint(joints), Contains("joints"));
  std::string layers = bytes;
  layers.replace(layers.find("[8,16,3]"), 8, "[8,16,1]");
  CHECK_THAT(complaint(layers), Contains("convolutions"));
  std::string version = bytes;
  version.replace(version.find("\"version\":1"), 11, "\"version\":9");
  CHECK_THAT(complaint(version), Contains("version"));
}

TEST_CASE("The net that is compiled in can be read, and its file is small") {
  CHECK(builtInJointNet().parameters.size() == makeJointNet().parameters.size());
}

TEST_CASE("Frame and grid points turn into each other") {
  for (const bool mirrored : {false, true}) {
    const FramePlacement placement{12, 3, mirrored};
    const Eigen::Vector2d p(20.5, 7.25);
    CHECK((placement.gridFromFrame(placement.frameFromGrid(p)) - p).norm() < 1e-12);
  }
  CHECK((frameFromCell(cellFromFrame({17, 30})) - Eigen::Vector2d(17, 30)).norm() < 1e-12);
}

TEST_CASE("A mirrored figure gives the mirrored input") {
  Rng rng(5);
  Plane8 mask = Plane8::Zero(101, 128), lines = mask;
  for (int y = 0; y < 101; ++y) {
    for (int x = 0; x < 128; ++x) {
      if (rng.chance(.7)) mask(y, x) = 255, lines(y, x) = static_cast<std::uint8_t>(rng.below(256));
    }
  }
  std::vector<float> a, b;
  encodeJointNetInput(mask, lines, FramePlacement::centred(mask), a);
  encodeJointNetInput(mask, lines, FramePlacement::centred(mask, true), b);
  int differ = 0;
  for (int y = 0; y < kNetInputSize; ++y) {
    for (int x = 0; x < kNetInputSize; ++x) {
      const float* p = &a[static_cast<std::size_t>(paddedIndex(kNetInputSize, y, x)) * kNetInputChannels];
      const float* q = &b[static_cast<std::size_t>(paddedIndex(kNetInputSize, y, kNetInputSize - 1 - x)) *
                          kNetInputChannels];
      for (int c = 0; c < kNetInputChannels; ++c) differ += c == 6 ? p[c] != -q[c] : p[c] != q[c];
    }
  }
  CHECK(differ == 0);
}

TEST_CASE("Background that is shut in is told from the outside") {
  Plane8 mask = Plane8::Constant(128, 128, 255);
  mask.block(40, 40, 40, 40) = 0;
  std::vector<float> input;
  encodeJointNetInput(mask, {}, FramePlacement::centred(mask), input);
  const auto hole = [&](int y, int x) {
    return input[static_cast<std::size_t>(paddedIndex(kNetInputSize, y, x)) * kNetInputChannels + 5];
  };
  CHECK(hole(34, 34) == 1);
  CHECK(hole(10, 10) == 0);
  CHECK(hole(0, 0) == 0);
}

}  // namespace
}  // namespace skel
