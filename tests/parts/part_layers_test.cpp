// Layers by the part net: which limbs become bodies of their own, and which stay with the skin.
#include <opencv2/core.hpp>

#include "libskel/core/files.h"
#include "libskel/core/segment.h"
#include "libskel/layers/layer_map.h"
#include "tests/support/catch.h"
#include "tests/support/synthetic_figure.h"

namespace skel {
namespace {

using Eigen::Vector2d;

const PartNet& net() {
  static const std::string path = SKEL_SOURCE_DIR "/weights/part_net.bin";
  static const PartNet read = readyToRun(parsePartNet(readFile(path), path));
  return read;
}

// Blue, the right arm orange with a black line around it, unless it is as blue as the rest.
struct Drawing {
  CapsuleFigure figure;
  Skeleton skeleton;
  SkeletonTemplate body_plan = loadTemplate("biped");
  Plane8 arm;  // 1 on the arm, its line included
  Image image;
  Silhouette silhouette;

  explicit Drawing(bool outlined, CapsuleFigure of = {.size = 400, .right_arm = 0, .right_forearm = -80})
      : figure(of), skeleton(capsuleSkeleton(of)), image(capsuleImage(of)) {
    arm = Plane8::Zero(figure.size, figure.size);
    for (int y = 0; y < figure.size; ++y)
      for (int x = 0; x < figure.size; ++x) {
        const auto toBone = [&](const char* from, const char* to) {
          const auto at = [&](const char* joint) {
            return skeleton.joints[std::size_t(skeleton.index(joint))].image;
          };
          return distanceToSegment<Vector2d>(Vector2d(x, y), at(from), at(to));
        };
        const double distance =
            std::min(toBone("right_shoulder", "right_elbow"), toBone("right_elbow", "right_hand"));
        if (distance > figure.limb_radius) continue;
        arm(y, x) = 1;
        if (!outlined) continue;
        const bool line = distance > figure.limb_radius - 3;
        std::uint8_t* p = image.pixel(x, y);
        p[0] = line ? 20 : 240, p[1] = line ? 20 : 160, p[2] = line ? 20 : 60;
      }
    silhouette = silhouetteFromMask(capsuleMask(figure));
  }
  LayerMap layers() const { return findPartLayers(image, silhouette, skeleton, body_plan, net()); }
};

TEST_CASE(
    "an arm drawn before the chest is a layer by the part net, its outline with it, and nothing else is") {
  const Drawing drawing(true);
  const LayerMap layers = drawing.layers();
  REQUIRE(layers.any());
  const Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> right_arm = layers.limb == 1,
                                                                            truth = drawing.arm != 0;
  CHECK(double((right_arm && truth).count()) / double((right_arm || truth).count()) > .85);
  CHECK((layers.limb > 1).count() == 0);
  CHECK(((layers.limb != 0) && (drawing.silhouette.mask == 0)).count() == 0);
}

TEST_CASE("free limbs, and those that nothing tells from the body, are no layers by the part net either") {
  CHECK_FALSE(Drawing(false, {.size = 400}).layers().any());
  CHECK_FALSE(Drawing(false).layers().any());
}

TEST_CASE("an arm that nothing tells from the body is hidden by the part net where its hand is a guess") {
  Drawing drawing(false, {.size = 400, .right_arm = -30, .right_forearm = -30});
  CHECK(drawing.layers().hidden.empty());
  drawing.skeleton.joints[std::size_t(drawing.skeleton.index("right_hand"))].confidence = .5;
  CHECK(drawing.layers().hidden == std::vector<int>{1});
}

TEST_CASE("a body plan with other limbs than two arms and two legs is one skin to the part net") {
  Drawing drawing(true);
  drawing.body_plan.limbs.pop_back();
  const LayerMap layers = drawing.layers();
  CHECK_FALSE(layers.any());
  CHECK(layers.hidden.empty());
}

}  // namespace
}  // namespace skel
