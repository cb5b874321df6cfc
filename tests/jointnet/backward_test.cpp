#include "trainer/conv_net_backward.h"

#include <cmath>

#include "libskel/core/rng.h"
#include "tests/support/catch.h"
#include "trainer/joint_loss.h"

namespace skel {
namespace {

constexpr int kJoints = 14;

JointTarget someTarget(Rng& rng, bool whole) {
  JointTarget target;
  target.joints.resize(kJoints);
  for (auto& joint : target.joints) {
    joint.cell = {rng.uniform(5, 30), rng.uniform(5, 30)};
    joint.weight = rng.uniform(.3, 1);
  }
  target.whole = whole;
  return target;
}

TEST_CASE("The loss has the derivative that its differences show") {
  Rng rng(1);
  std::vector<double> map(MapShape{kHeatmapSize, kHeatmapSize, heatmapChannels(kJoints)}.paddedSize(), 0.);
  for (double& v : map) v = rng.normal();
  const JointTarget target = someTarget(rng, rng.chance(.5));
  std::vector<double> gradient(map.size(), 0.);
  jointLoss<double>(map, target, 1, &gradient);
  for (int k = 0; k < 200; ++k) {
    const int pixel =
        paddedIndex(kHeatmapSize, static_cast<int>(rng.below(36)), static_cast<int>(rng.below(36)));
    const std::size_t i = static_cast<std::size_t>(pixel) * heatmapChannels(kJoints) + rng.below(15);
    const double before = map[i], h = 1e-5;
    map[i] = before + h;
    const double above = jointLoss<double>(map, target, 1, nullptr);
    map[i] = before - h;
    const double below = jointLoss<double>(map, target, 1, nullptr);
    map[i] = before;
    INFO("value " << i);
    CHECK(std::abs((above - below) / (2 * h) - gradient[i]) < 1e-8);
  }
}

TEST_CASE("Perfect heatmaps cost no more than the target's own entropy") {
  Rng rng(2);
  const JointTarget target = someTarget(rng, true);
  std::vector<double> map(MapShape{kHeatmapSize, kHeatmapSize, heatmapChannels(kJoints)}.paddedSize(), 0.);
  double weight = 0;
  for (int j = 0; j < kJoints; ++j) {
    weight += target.joints[j].weight / kJoints;
    for (int y = 0; y < kHeatmapSize; ++y) {
      for (int x = 0; x < kHeatmapSize; ++x) {
        const double d = (Eigen::Vector2d(x, y) - target.joints[j].cell).squaredNorm();
        const std::size_t i =
            static_cast<std::size_t>(paddedIndex(kHeatmapSize, y, x)) * heatmapChannels(kJoints);
        map[i + j] = -d / (2 * kTargetVariance);
        map[i + kJoints] = 20;
      }
    }
  }
  const double entropy = std::log(2 * 3.14159265 * kTargetVariance) + 1;
  CHECK(jointLoss<double>(map, target, 1, nullptr) == Approx(weight * entropy).epsilon(.02));
}

TEST_CASE("The best heatmap of a joint that the figure has none of is an even one") {
  JointTarget target;
  target.joints.assign(kJoints, {Eigen::Vector2d(10, 10), 0});
  target.joints[2] = {Eigen::Vector2d(10, 10), 1, true};
  target.whole = true;
  std::vector<double> even(
      static_cast<std::size_t>(paddedPixels(kHeatmapSize, kHeatmapSize)) * heatmapChannels(kJoints), 0.);
  std::vector<double> sharp = even, gradient(even.size(), 0.);
  sharp[static_cast<std::size_t>(paddedIndex(kHeatmapSize, 10, 10)) * heatmapChannels(kJoints) + 2] = 3;
  CHECK(jointLoss<double>(even, target, 1, &gradient) < jointLoss<double>(sharp, target, 1, nullptr));
  for (int y = 0; y < kHeatmapSize; ++y)
    CHECK(std::abs(
              gradient[static_cast<std::size_t>(paddedIndex(kHeatmapSize, y, y)) * heatmapChannels(kJoints) +
                       2]) < 1e-12);
}

TEST_CASE("In side views, mirrored or not, the limb at the left of the picture is called the right one") {
  FigureOptions options;
  options.body_plan = GENERATE("biped", "quadruped");
  const NetJoints joints =
      netJoints(jointNames(figurePlan(options.body_plan)), loadTemplate(options.body_plan));
  Rng rng(4);
  int seen = 0;
  while (seen < 20) {
    const Figure figure = generateFigure(rng, options);
    if (figure.view != FigureView::kSide) continue;
    ++seen;
    for (const bool mirrored : {false, true}) {
      const JointTarget target = jointTarget(figure, FramePlacement::centred(figure.mask, mirrored), joints);
      for (const std::vector<int>& limb : joints.limbs) {
        double left = 0, right = 0;
        for (const int j : limb)
          left += target.joints[j].cell.x(), right += target.joints[joints.mirrored[j]].cell.x();
        INFO(joints.names[limb[0]] << (mirrored ? ", mirrored" : ""));
        CHECK(right <= left);
      }
    }
  }
}

// Along a random direction d of the parameters: loss(w + h d) - loss(w - h d) = 2 h <gradient, d>. In float a
// step that is small enough for the curvature drowns in rounding where few cells count, so the step is long
// and the net's kinks leave some error.
TEST_CASE("The whole net has the derivative that its differences show") {
  JointNet net = makeJointNet("biped", std::vector<std::string>(kJoints));
  Rng rng(3);
  for (const ConvLayer& layer : net.layers) {
    if (layer.kind != ConvLayer::Kind::kConvolution) continue;
    const ConvShape shape = convShape(net, layer);
    const double size = std::sqrt(1. / (shape.taps() * shape.in_channels));
    for (std::size_t k = layer.weights; k < layer.biases; ++k)
      net.parameters[k] = static_cast<float>(size * rng.normal());
    for (int c = 0; c < layer.channels; ++c)
      net.parameters[layer.biases + c] = static_cast<float>(.1 * rng.normal());
  }
  ConvNetMaps maps(net);
  Plane8 mask = Plane8::Zero(128, 60);
  mask.block(0, 10, 128, 30) = 255;
  mask.block(30, 0, 20, 60) = 255;
  encodeJointNetInput(mask, {}, FramePlacement::centred(mask), kNetInputChannels, maps.maps[0]);
  const JointTarget target = someTarget(rng, true);

  for (const InstructionSet set : kInstructionSets) {
    if (!hasInstructionSet(set)) continue;
    ConvNetGradient gradient(net);
    forward(net, set, maps);
    jointLoss<float>(maps.maps.back(), target, 1, &gradient.maps.back());
    backward(net, set, transposedWeights(net), maps, gradient);

    const auto lossAlong = [&](const std::vector<float>& direction, double h) {
      JointNet moved = net;
      for (std::size_t i = 0; i < direction.size(); ++i)
        moved.parameters[i] += static_cast<float>(h * direction[i]);
      forward(moved, set, maps);
      return jointLoss<float>(maps.maps.back(), target, 1, nullptr);
    };
    // One direction a layer, so that no layer's mistake can hide.
    for (std::size_t l = 0; l < net.layers.size(); ++l) {
      const ConvLayer& layer = net.layers[l];
      if (layer.kind != ConvLayer::Kind::kConvolution) continue;
      std::vector<float> direction(net.parameters.size(), 0.f);
      double slope = 0, length = 0;
      for (std::size_t i = layer.weights; i < layer.biases + static_cast<std::size_t>(layer.channels); ++i) {
        // Mostly downhill, so that the slope is not lost among the directions.
        direction[i] = gradient.parameters[i];
        slope += static_cast<double>(direction[i]) * gradient.parameters[i];
        length += static_cast<double>(direction[i]) * direction[i];
      }
      length = std::sqrt(length);
      REQUIRE(length > 0);
      const double h = 2e-3 / length;
      INFO(instructionSetName(set) << ", layer " << l);
      CHECK((lossAlong(direction, h) - lossAlong(direction, -h)) / (2 * h) == Approx(slope).epsilon(.02));
    }
  }
}

}  // namespace
}  // namespace skel
