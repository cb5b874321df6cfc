// A chest is shallower than wide, a head is a ball on a narrower neck, limbs are tubes, an animal is narrower
// than high: proportions as in A. Loomis, "Figure drawing for all it's worth" (1943), and by eye.
#include "libskel/pipeline/body_depth.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "libskel/layers/part_net.h"
#include "libskel/pipeline/trunk_sections.h"
#include "libskel/silhouette/outline.h"
#include "libskel/skeleton/frontal.h"

namespace skel {
namespace {

using Eigen::Vector2d;

// Of a part of the body: DepthBone::source, and the most half depth in radii of its flesh.
struct Build {
  double source, most;
};
constexpr Build kHeadBuild{5, 1.6}, kChestBuild{2.4, 1}, kLimbBuild{2.5, 2};
constexpr Build kBallBuild{4, 1.3};  // head and trunk in one: a potato, a crab
// Of the larger of head and trunk: what is as wide between them is no neck; and they are no farther apart.
constexpr double kNoNeck = 0.95, kInOne = 1.8;
constexpr Build kSideChestBuild{2.5, 1.4};                               // of a person drawn from the side
constexpr Build kAnimalTrunkBuild{2, 1.05}, kAnimalHeadBuild{2.2, 1.2};  // drawn from the side, always
constexpr double kForward = 0.5;     // DepthBone::forward of who faces the viewer; by eye, of .5 and .7
constexpr double kFacing = 0.5;      // frontal(), of who shows little of his side
constexpr double kLimbRadius = 0.4;  // at most, as a share of a bone's length: where it lies on the body
// Of the head's radius: how far the throat lies below the middle of the head, how far it narrows, its half
// width and its most half depth.
constexpr double kChin = 1.15, kNeckReach = 0.75, kNeckWide = 0.9, kNeckDepth = 0.5;
constexpr double kAside =
    0.4;  // of legs seen from the side, from the middle: share of the trunk's half depth

constexpr double kCapeThickness = 0.4;

class DepthFinder {
 public:
  DepthFinder(const Skeleton& skeleton, const SkeletonTemplate& body_plan, const Silhouette& silhouette,
              const std::vector<int>& far, const std::vector<int>& cut, const Plane8& parts)
      : skeleton_(skeleton),
        body_plan_(body_plan),
        silhouette_(silhouette),
        far_(far),
        cut_(cut),
        parts_(parts) {}

  BodyDepth operator()() {
    const auto pelvis = at("pelvis"), body = at("body"), neck = at("neck"), head = at("head"),
               top = at("head_top");
    if (!pelvis || !body || !neck || !head) return {};
    const double head_px = radius(*head), neck_px = radius(*neck), body_px = radius(*body);
    const bool in_one = !body_plan_.from_side && neck_px > kNoNeck * std::max(head_px, body_px) &&
                        (*head - *body).norm() < kInOne * neck_px;
    const double front = frontal(skeleton_, body_plan_);
    forward_ = kForward * front;
    aside_ = kAside * (1 - front);
    const Build trunk = in_one ? kBallBuild : trunkBuild(front);
    const double trunk_px = in_one ? neck_px : body_px;
    addBone(*pelvis, *body, trunk_px, trunk);
    addBone(*body, *neck, trunk_px, trunk);
    for (DepthBone& bone : depth_.bones) bone.trunk = true;
    const Vector2d up = top ? Vector2d(*top - *head) : Vector2d(*head - *neck);
    addBone(*head, *head + 0.5 * up.normalized() * std::min(up.norm(), head_px), in_one ? neck_px : head_px,
            body_plan_.from_side ? kAnimalHeadBuild
            : in_one             ? kBallBuild
                                 : kHeadBuild);
    if (!body_plan_.from_side && front > kFacing) {
      if (!in_one) addNeck(*neck, *head, head_px);
      depth_.sections = trunkSections(parts_, silhouette_.mask, {*neck, *body, *pelvis, trunk_px});
      addCapes();
    }
    for (std::size_t k = 0; k < body_plan_.limbs.size(); ++k)
      addLimb(body_plan_.limbs[k], static_cast<int>(k) + 1, trunk, trunk_px);
    if (const auto root = at("tail_root"), tail = at("tail"); root && tail)
      addBone(*root, *tail, std::min(radius((*root + *tail) / 2), kLimbRadius * (*root - *tail).norm()),
              kLimbBuild);
    return depth_;
  }

 private:
  std::optional<Vector2d> at(const std::string& name) const {
    const int joint = skeleton_.find(name);
    if (joint < 0) return std::nullopt;
    return skeleton_.joints[static_cast<std::size_t>(joint)].image;
  }
  std::optional<Vector2d> at(int of_plan) const {
    return at(body_plan_.joints[static_cast<std::size_t>(of_plan)].name);
  }

  // Of the disc around the point that touches the outline first.
  double radius(const Vector2d& p) const { return std::max(distanceToOutline(silhouette_.outline, p), 1.0); }

  void addBone(const Vector2d& from, const Vector2d& to, double radius_px, const Build& build,
               int layer = 0) {
    radius_px = std::max(radius_px, 1.0);
    depth_.bones.push_back({from, to, radius_px, build.source, build.most * radius_px, layer, forward_});
  }

  Build trunkBuild(double front) const {
    if (body_plan_.from_side) return kAnimalTrunkBuild;
    return {kSideChestBuild.source + front * (kChestBuild.source - kSideChestBuild.source),
            kSideChestBuild.most + front * (kChestBuild.most - kSideChestBuild.most)};
  }

  void addNeck(const Vector2d& neck, const Vector2d& head, double head_px) {
    const Vector2d down = neck - head;
    if (down.norm() < 1) return;
    const Vector2d chin = head + down.normalized() * std::min(kChin * head_px, down.norm());
    depth_.neck = {chin, -down.normalized(), kNeckReach * head_px, kNeckWide * head_px,
                   std::min(radius(chin), kNeckDepth * head_px)};
  }

  void addCapes() {
    const auto is_cape = parts_ == static_cast<std::uint8_t>(Part::kAppendix);
    if (is_cape.any()) depth_.capes = {is_cape.cast<std::uint8_t>(), kCapeThickness};
  }

  void addLimb(const TemplateLimb& limb, int layer, const Build& trunk, double trunk_px) {
    const auto root = at(limb.joints[0]), middle = at(limb.joints[1]), end = at(limb.joints[2]);
    if (!root || !middle || !end) return;
    // Where it hangs on the trunk it is as deep as that.
    addBone(*root, *root, trunk_px / 2, {trunk.source, 2 * trunk.most});
    depth_.bones.back().trunk = true;
    const auto tube = [&](const Vector2d& a, const Vector2d& b) {
      return std::min(radius((a + b) / 2), kLimbRadius * (a - b).norm());
    };
    // Legs that stand: one that is stretched out, or short, is moved less.
    const double drop = std::max(0., (*end - *root).normalized().y()), length = (*end - *root).norm();
    const double aside_px = legSide(layer) * aside_ * drop * std::min(trunk.most * trunk_px, length);
    addBone(*root + 0.3 * (*middle - *root), *middle, tube(*root, *middle), kLimbBuild, layer);
    depth_.bones.back().to_aside_px = aside_px;
    const double lower_px = tube(*middle, *end);
    const bool stands = limb.limb_class == JointClass::kLeg && !body_plan_.from_side;
    addBone(*middle, *end + 0.3 * (*end - *middle), lower_px, kLimbBuild, layer);
    depth_.bones.back().from_aside_px = depth_.bones.back().to_aside_px = aside_px;
    if (stands) depth_.feet.push_back({*middle, *end, lower_px, layer});
  }

  // 1: the nearer one of two legs, -1: the farther one; where that is unknown, the first is the nearer. 0: an
  // arm, or a leg of a pair that is cut.
  int legSide(int limb) const {
    const auto holds = [](const std::vector<int>& limbs, int k) {
      return std::find(limbs.begin(), limbs.end(), k + 1) != limbs.end();
    };
    for (const auto& [a, b] : body_plan_.limbPairs()) {
      if (limb != a + 1 && limb != b + 1) continue;
      if (!body_plan_.from_side &&
          body_plan_.limbs[static_cast<std::size_t>(a)].limb_class != JointClass::kLeg)
        return 0;
      if (holds(cut_, a) || holds(cut_, b)) return 0;
      const int farther = holds(far_, a) && !holds(far_, b) ? a : b;
      return limb == farther + 1 ? -1 : 1;
    }
    return 0;
  }

  const Skeleton& skeleton_;
  const SkeletonTemplate& body_plan_;
  const Silhouette& silhouette_;
  const std::vector<int>&far_, &cut_;
  const Plane8& parts_;
  double aside_ = 0;    // share of the trunk's half depth
  double forward_ = 0;  // DepthBone::forward
  BodyDepth depth_;
};

}  // namespace

BodyDepth bodyDepth(const Skeleton& skeleton, const SkeletonTemplate& body_plan, const Silhouette& silhouette,
                    const std::vector<int>& far, const std::vector<int>& cut, const Plane8& parts) {
  return DepthFinder(skeleton, body_plan, silhouette, far, cut, parts)();
}

}  // namespace skel
