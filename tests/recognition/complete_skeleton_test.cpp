#include "libskel/recognition/complete_skeleton.h"

#include <limits>

#include "libskel/core/rng.h"
#include "libskel/recognition/nearest_pixel.h"
#include "tests/support/catch.h"

using namespace skel;
using Eigen::Vector2d;

namespace {

Plane8 randomMask(Rng& rng, int width, int height) {
  Plane8 mask(height, width);
  for (Eigen::Index i = 0; i < mask.size(); ++i) mask(i) = rng.chance(0.02) ? 255 : 0;
  mask(height / 2, width / 2) = 255;
  return mask;
}

bool lies(const Plane8& mask, const Vector2d& p) { return mask(std::lround(p.y()), std::lround(p.x())) != 0; }

}  // namespace

TEST_CASE("a point moves to the nearest pixel of the figure, and stays if it is on one") {
  Rng rng(3);
  for (int round = 0; round < 50; ++round) {
    const Plane8 mask = randomMask(rng, 40, 30);
    const Vector2d p(rng.uniform(-20, 60), rng.uniform(-20, 50));
    const Vector2d moved = NearestPixel(mask).to(p);
    double least = std::numeric_limits<double>::infinity();
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 40; ++x)
        if (mask(y, x)) least = std::min(least, (Vector2d(x, y) - p).norm());
    REQUIRE(lies(mask, moved));
    if (moved != p) CHECK((moved - p).norm() == Approx(least));
  }
}

TEST_CASE("a hundred thousand joints far from a thin figure find it") {
  Plane8 mask = Plane8::Zero(3000, 3000);
  mask.row(2999).setConstant(255);
  mask.col(0).setConstant(255);
  const NearestPixel nearest(mask);
  // In squares that grow round each, 4e11 pixels would be looked at.
  for (int y = 0; y < 1000; y += 10)
    for (int x = 0; x < 1000; ++x) {
      const Vector2d p(1999.5 + x, y), moved = nearest.to(p);
      const Vector2d wanted = p.x() < 2999 - p.y() ? Vector2d(0, p.y()) : Vector2d(std::round(p.x()), 2999);
      if ((moved - p).norm() > (wanted - p).norm() + 1e-9) FAIL(p.transpose() << " to " << moved.transpose());
    }
  SUCCEED();
}

TEST_CASE("missing joints follow the found ones around them") {
  const SkeletonTemplate biped = loadTemplate("biped");
  const Silhouette block = silhouetteFromMask(Plane8::Constant(200, 100, 255));
  REQUIRE(block.found());
  Skeleton skeleton = presetSkeleton(biped, {-0.5, -0.5}, {99.5, 199.5});
  const Skeleton preset = skeleton;
  std::vector<bool> found(17, false);
  for (const char* name : {"head", "body"}) {
    skeleton.joints[skeleton.index(name)].image += Vector2d(7, -3);
    found[static_cast<size_t>(skeleton.index(name))] = true;
  }
  completeSkeleton(skeleton, found, biped, block);
  for (const char* name : {"left_hand", "right_knee", "left_foot"})
    CHECK((skeleton.joints[skeleton.index(name)].image - preset.joints[preset.index(name)].image)
              .isApprox(Vector2d(7, -3)));
  const auto at = [&](const char* name) { return skeleton.joints[skeleton.index(name)].image; };
  CHECK(at("pelvis").isApprox((at("left_hip") + at("right_hip")) / 2));
  CHECK(at("neck").isApprox((at("left_shoulder") + at("right_shoulder")) / 2));
  CHECK(at("head_top").y() < at("head").y());
  CHECK(skeleton.joints[skeleton.index("neck")].origin == JointOrigin::kDerived);
}

TEST_CASE("joints that coincide are moved apart") {
  const SkeletonTemplate biped = loadTemplate("biped");
  const Silhouette block = silhouetteFromMask(Plane8::Constant(256, 256, 255));
  Skeleton skeleton = presetSkeleton(biped, {0, 0}, {255, 255});
  for (Joint& joint : skeleton.joints) joint.image = {128, 128};
  completeSkeleton(skeleton, std::vector<bool>(17, true), biped, block);
  for (const char* name : {"left_elbow", "left_hand", "right_knee", "right_foot"}) {
    const Joint& joint = skeleton.joints[skeleton.index(name)];
    const Joint& parent = skeleton.joints[static_cast<size_t>(joint.parent)];
    CHECK((joint.image - parent.image).norm() >= 2 * biped.rules.separation_px - 1e-9);
  }
}

TEST_CASE("all joints come to lie on the figure, whatever it is") {
  const SkeletonTemplate biped = loadTemplate("biped");
  Rng rng(5);
  for (int round = 0; round < 40; ++round) {
    Plane8 mask = Plane8::Zero(60, 50);
    for (int i = 0; i < 3; ++i) {
      const int x = rng.below(45), y = rng.below(55), w = 1 + rng.below(30), h = 1 + rng.below(30);
      mask.block(y, x, std::min(h, 60 - y), std::min(w, 50 - x)).setConstant(255);
    }
    const Silhouette silhouette = silhouetteFromMask(mask);
    if (!silhouette.found()) continue;
    Skeleton skeleton = presetSkeleton(biped, {-30, -30}, {90, 90});
    completeSkeleton(skeleton, std::vector<bool>(17, round % 2 == 0), biped, silhouette);
    for (const Joint& joint : skeleton.joints) REQUIRE(lies(silhouette.mask, joint.image));
  }
}
