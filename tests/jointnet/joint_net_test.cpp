#include "libskel/jointnet/joint_net.h"

#include <algorithm>
#include <cmath>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/rng.h"
#include "libskel/jointnet/net_joints.h"
#include "tests/support/catch.h"
#include "trainer/figures/drawing.h"

namespace skel {
namespace {

JointNet randomNet() {
  JointNet net = makeJointNet("spider", {"head", "left_leg", "right_leg"});
  Rng rng(1);
  for (const ConvLayer& layer : net.layers) {
    if (layer.kind != ConvLayer::Kind::kConvolution) continue;
    const ConvShape shape = convShape(net, layer);
    const double size = std::sqrt(1. / (shape.taps() * shape.in_channels));
    for (std::size_t k = layer.weights; k < layer.biases; ++k)
      net.parameters[k] = static_cast<float>(size * rng.normal());
  }
  net.provenance = "random";
  net.bones = {{}, {3, .25, 0, 0}, {3.5, .5, -.125, .25}};
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
  CHECK(bytes.size() < 2'000'000);
  const JointNet read = parseJointNet(bytes, "net.bin");
  JointNet rounded = net;
  quantize(rounded);
  CHECK(read.parameters == rounded.parameters);
  CHECK(read.provenance == "random");
  CHECK(read.body_plan == "spider");
  REQUIRE(read.bones.size() == 3);
  CHECK(read.bones[2].deviation == .5);
  CHECK(read.bones[2].ratio_mean == -.125);
  CHECK(read.joints == net.joints);
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
  joints.replace(joints.find("right_leg"), 9, "left_leg\",\"left_leg");
  CHECK_THAT(complaint(joints), Contains("joints[2]: is the second joint named \"left_leg\""));
  std::string none = bytes;
  none.replace(none.find("[\"head\",\"left_leg\",\"right_leg\"]"), 31, "[]");
  CHECK_THAT(complaint(none), Contains("joints: has 0 joints, must have 1 to 63"));
  std::string layers = bytes;
  layers.replace(layers.find("[32,32,3]"), 9, "[32,32,1]");
  CHECK_THAT(complaint(layers), Contains("convolutions"));
  std::string bones = bytes;
  bones.replace(bones.find("[3.0,0.25,0.0,0.0],"), 19, "");
  CHECK_THAT(complaint(bones), Contains("bones: has 2 entries for 3 joints"));
  bones = bytes;
  bones.replace(bones.find("0.25,0.0,0.0]"), 4, "-1.0");
  CHECK_THAT(complaint(bones), Contains("bones[1]: has a deviation below 0"));
  const auto hourglasses = [&](const std::string& count) {
    std::string other = bytes;
    other.replace(other.find("\"hourglasses\":1"), 15, "\"hourglasses\":" + count);
    return complaint(other);
  };
  CHECK_THAT(hourglasses("0"), Contains("hourglasses"));
  CHECK_THAT(hourglasses("9"), Contains("hourglasses"));
  CHECK_THAT(hourglasses("1.5"), Contains("hourglasses"));
  CHECK_THAT(hourglasses("2"), Contains("convolutions"));
  std::string version = bytes;
  version.replace(version.find("\"version\":3"), 11, "\"version\":9");
  CHECK_THAT(complaint(version), Contains("version"));
}

TEST_CASE("A net of a million joints is refused before they are compared with each other") {
  std::string names;
  for (int i = 0; i < 1'000'000; ++i) names += (i ? ",\"" : "\"") + std::to_string(i) + "\"";
  CHECK(
      complaint(
          R"({"format":"skel-joint-net","version":1,"provenance":"","convolutions":[],"sha256":"","joints":[)" +
          names + "]}\n") == "net.bin: joints: has 1000000 joints, must have 1 to 63");
}

TEST_CASE("A net whose weights are so large that it answers no numbers is refused, and crashes nothing") {
  JointNet net = randomNet();
  const ConvLayer& last = net.layers.back();
  std::fill(net.parameters.begin() + static_cast<std::ptrdiff_t>(last.weights), net.parameters.end(), 3e38f);
  net = parseJointNet(formatJointNet(net), "net.bin");
  ConvNetMaps maps(net);
  std::fill(maps.maps[0].begin(), maps.maps[0].end(), 1.f);
  CHECK_THROWS_WITH(forward(net, bestInstructionSet(), maps),
                    "a net's answer is no number: its weights are damaged; train it anew");
}

TEST_CASE("A net that is ready to run says what it said before") {
  JointNet net = makeJointNet("spider", {"head", "left_leg", "right_leg"}, 2);
  Rng rng(2);
  for (float& w : net.parameters) w = static_cast<float>(.03 * rng.normal());
  const JointNet ready = readyToRun(net);
  REQUIRE(ready.transformed);
  ConvNetMaps plain(net), transformed(net);
  Plane8 mask = Plane8::Zero(128, 60);
  mask.block(0, 10, 128, 30) = 255;
  for (ConvNetMaps* maps : {&plain, &transformed})
    encodeJointNetInput(mask, {}, FramePlacement::centred(mask), net.maps[0].channels, maps->maps[0]);
  forward(net, bestInstructionSet(), plain);
  forward(ready, bestInstructionSet(), transformed);
  float largest = 0, worst = 0;
  for (std::size_t i = 0; i < plain.maps.back().size(); ++i) {
    largest = std::max(largest, std::abs(plain.maps.back()[i]));
    worst = std::max(worst, std::abs(plain.maps.back()[i] - transformed.maps.back()[i]));
  }
  CHECK(largest > 1e-3f);
  CHECK(worst < 1e-4f * largest);
  // What has been changed must not be run as it was.
  JointNet changed = ready;
  quantize(changed);
  CHECK_FALSE(changed.transformed);
}

TEST_CASE("The nets that are compiled in know their templates") {
  for (const std::string_view name : builtInJointNets().bodyPlans()) {
    INFO(name);
    const SkeletonTemplate body_plan = loadTemplate(std::string(name));
    CHECK(builtInJointNets().of(name).body_plan == name);
    CHECK(jointNetFor(body_plan, builtInJointNets()) == &builtInJointNets().of(name));
    CHECK(netJoints(builtInJointNets().of(name).joints, body_plan).count() ==
          std::count_if(body_plan.joints.begin(), body_plan.joints.end(),
                        [](const TemplateJoint& joint) { return !joint.derived; }));
  }
}

TEST_CASE("The nets that are compiled in are the files of weights/, which fit their hashes") {
  const auto file =
      GENERATE(std::pair("biped", "joint_net.bin"), std::pair("quadruped", "quadruped_joint_net.bin"));
  const std::string path = std::string(SKEL_SOURCE_DIR "/weights/") + file.second;
  CHECK(parseJointNet(readFile(path), path).parameters == builtInJointNets().of(file.first).parameters);
}

TEST_CASE("Files of every version can be read") {
  struct Version {
    const char* file;
    double heatmap_value;  // what it finds is pinned down by one
  };
  const auto version =
      GENERATE(Version{"joint-net-version-1.bin", -0.40456}, Version{"joint-net-version-2.bin", -19.40218},
               Version{"joint-net-two-hourglasses.bin", -31.26297});
  const std::string file = std::string(SKEL_SOURCE_DIR "/weights/archive/") + version.file;
  const JointNet net = parseJointNet(readFile(file), file);
  CHECK(net.body_plan == "biped");
  CHECK(net.joints == jointNames(figurePlan("biped")));
  ConvNetMaps maps(net);
  encodeJointNetInput(Plane8::Constant(128, 40, 255), {}, {52, 8}, net.maps[0].channels, maps.maps[0]);
  forward(net, InstructionSet::kBaseline, maps);
  CHECK(maps.maps.back()[static_cast<std::size_t>(paddedIndex(kHeatmapSize, 10, 18)) * heatmapChannels(14)] ==
        Approx(version.heatmap_value).epsilon(1e-3));
}

TEST_CASE("Joints of a net hang together as the template says") {
  const SkeletonTemplate biped = loadTemplate("biped");
  const std::vector<std::string> names = {"left_knee", "left_hip",   "head",          "body",
                                          "right_hip", "right_knee", "left_shoulder", "right_shoulder"};
  const NetJoints joints = netJoints(names, biped);
  CHECK(joints.mirrored == std::vector<int>{5, 4, 2, 3, 1, 0, 7, 6});
  CHECK(joints.parent == std::vector<int>{1, 3, 3, -1, 3, 4, 3, 3});
  CHECK(joints.order == std::vector<int>{3, 4, 5, 6, 7, 1, 2, 0});
  CHECK(joints.limbs == std::vector<std::vector<int>>{{6}, {1, 0}});
  CHECK_THROWS_WITH(netJoints({"body", "tail"}, biped),
                    "the template \"biped\" has no joint \"tail\" that could be found in a drawing");
  CHECK_THROWS_WITH(netJoints({"body", "pelvis"}, biped),
                    "the template \"biped\" has no joint \"pelvis\" that could be found in a drawing");
  CHECK_THROWS_WITH(netJoints({"head"}, biped),
                    "the net does not find the body joint of the template \"biped\"");
  CHECK_THROWS_WITH(netJoints({"body", "left_hip"}, biped),
                    "the net finds \"left_hip\" but not its counterpart of the other side");
}

TEST_CASE("A template of another name takes the net that finds its joints") {
  SkeletonTemplate body_plan = loadTemplate("biped");
  body_plan.name = "pirate";
  CHECK(jointNetFor(body_plan, builtInJointNets()) == &builtInJointNets().of("biped"));
  body_plan.joints[static_cast<size_t>(body_plan.find("left_hand"))].name = "left_hook";
  CHECK(jointNetFor(body_plan, builtInJointNets()) == nullptr);
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
  Plane8 mask = Plane8::Zero(101, 128);
  FigureLook look{mask, {}};
  look.tones.fill(Plane8::Constant(101, 128, kMeanTone));
  for (int y = 0; y < 101; ++y) {
    for (int x = 0; x < 128; ++x) {
      if (!rng.chance(.7)) continue;
      mask(y, x) = 255;
      for (Plane8* plane : {&look.lines, &look.tones[0], &look.tones[1], &look.tones[2]})
        (*plane)(y, x) = static_cast<std::uint8_t>(rng.below(256));
    }
  }
  std::vector<float> a, b;
  encodeJointNetInput(mask, look, FramePlacement::centred(mask), kNetInputChannels, a);
  encodeJointNetInput(mask, look, FramePlacement::centred(mask, true), kNetInputChannels, b);
  int differ = 0;
  for (int y = 0; y < kNetInputSize; ++y) {
    for (int x = 0; x < kNetInputSize; ++x) {
      const float* p = &a[static_cast<std::size_t>(paddedIndex(kNetInputSize, y, x)) * kNetInputChannels];
      const float* q = &b[static_cast<std::size_t>(paddedIndex(kNetInputSize, y, kNetInputSize - 1 - x)) *
                          kNetInputChannels];
      for (int c = 0; c < 12; ++c) differ += c == 6 ? p[c] != -q[c] : p[c] != q[c];
      for (int c = 12; c < 32; ++c) differ += p[c] != q[c ^ 1];
    }
  }
  CHECK(differ == 0);
}

TEST_CASE("Background that is shut in is told from the outside") {
  Plane8 mask = Plane8::Constant(128, 128, 255);
  mask.block(40, 40, 40, 40) = 0;
  std::vector<float> input;
  encodeJointNetInput(mask, {}, FramePlacement::centred(mask), kNetInputChannels, input);
  const auto hole = [&](int y, int x) {
    return input[static_cast<std::size_t>(paddedIndex(kNetInputSize, y, x)) * kNetInputChannels + 5];
  };
  CHECK(hole(34, 34) == 1);
  CHECK(hole(10, 10) == 0);
  CHECK(hole(0, 0) == 0);
}

}  // namespace
}  // namespace skel
