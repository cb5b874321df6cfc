#include "libskel/recognition/complete_skeleton.h"

#include <algorithm>
#include <cmath>

#include "libskel/core/check.h"
#include "libskel/recognition/nearest_pixel.h"

namespace skel {
namespace {

using Eigen::Vector2d;

// Shepard's interpolation (1968): what the found joints differ from their presets, weighted by inverse
// squared distance.
void placeMissing(Skeleton& skeleton, const std::vector<bool>& found, const Skeleton& preset,
                  double figure_size_px) {
  if (std::none_of(found.begin(), found.end(), [](bool f) { return f; })) return;
  const double softening = 0.01 * figure_size_px;
  for (size_t i = 0; i < skeleton.joints.size(); ++i) {
    if (found[i]) continue;
    Vector2d shift = Vector2d::Zero();
    double total = 0;
    for (size_t k = 0; k < skeleton.joints.size(); ++k) {
      if (!found[k]) continue;
      const double distance = (preset.joints[i].image - preset.joints[k].image).norm() + softening;
      const double weight = 1 / (distance * distance);
      shift += weight * (skeleton.joints[k].image - preset.joints[k].image);
      total += weight;
    }
    skeleton.joints[i].image = preset.joints[i].image + shift / total;
  }
}

// The last point of the figure on the way from `from` through `through`, then a little back.
Vector2d tipBeyond(const Plane8& mask, const Vector2d& from, const Vector2d& through) {
  constexpr double kShare = 0.92;  // of the way from `through` to the outline
  const Vector2d way = through - from;
  const Vector2d step = way.norm() > 1e-9 ? Vector2d(way.normalized() * 0.5) : Vector2d(0, -0.5);
  Vector2d last = through;
  while (onFigure(mask, last + step)) last += step;
  return through + kShare * (last - through);
}

void derive(Skeleton& skeleton, const SkeletonTemplate& body_plan, const Plane8& mask) {
  for (size_t i = 0; i < skeleton.joints.size(); ++i) {
    const auto& derived = body_plan.joints[i].derived;
    if (!derived) continue;
    const Joint& a = skeleton.joints[static_cast<size_t>(derived->from[0])];
    const Joint& b = skeleton.joints[static_cast<size_t>(derived->from[1])];
    Joint& joint = skeleton.joints[i];
    joint.image = derived->rule == DerivationRule::kTip ? tipBeyond(mask, a.image, b.image)
                                                        : Vector2d((a.image + b.image) / 2);
    joint.confidence = std::min(a.confidence, b.confidence);
    joint.origin = JointOrigin::kDerived;
  }
}

// A joint and its parent that coincide have no bone between them: the joint gives way along the preset's
// direction.
void separate(Skeleton& skeleton, const Skeleton& preset, double least_px) {
  for (size_t i = 1; i < skeleton.joints.size(); ++i) {
    Joint& joint = skeleton.joints[i];
    Joint& parent = skeleton.joints[static_cast<size_t>(joint.parent)];
    const double distance = (joint.image - parent.image).norm();
    if (distance >= least_px) continue;
    const Vector2d direction =
        (preset.joints[i].image - preset.joints[static_cast<size_t>(joint.parent)].image).normalized();
    joint.image += direction * (least_px - distance);
  }
}

}  // namespace

void completeSkeleton(Skeleton& skeleton, const std::vector<bool>& found, const SkeletonTemplate& body_plan,
                      const Silhouette& silhouette) {
  SKEL_CHECK_EQ(found.size(), skeleton.joints.size());
  SKEL_CHECK(silhouette.found());
  const WorkingGrid& grid = silhouette.grid;
  const Skeleton preset = presetSkeleton(body_plan, grid.imageFromGrid({-0.5, -0.5}),
                                         grid.imageFromGrid({grid.width - 0.5, grid.height - 0.5}));
  placeMissing(skeleton, found, preset, kWorkingGridSize / grid.scale);
  separate(skeleton, preset, body_plan.rules.separation_px / grid.scale);
  const NearestPixel nearest(silhouette.mask);
  for (size_t i = 0; i < skeleton.joints.size(); ++i)
    if (!body_plan.joints[i].derived) skeleton.joints[i].image = nearest.to(skeleton.joints[i].image);
  derive(skeleton, body_plan, silhouette.mask);
  for (Joint& joint : skeleton.joints) joint.image = nearest.to(joint.image);
}

}  // namespace skel
