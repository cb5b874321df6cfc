#include "labeler/joints_outside_mask.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "libskel/image/read_image.h"
#include "libskel/mesh/outline.h"
#include "libskel/skeleton/outside_figure.h"

namespace skel {
namespace {

// Of the figure's long side: joints of thin limbs lie a pixel or two beside them. In the labelled set of 278
// drawings no more than 2 of 14 joints lie farther out; of an inverted mask 6 at least.
constexpr double kBeside = .005, kMostOutside = 1 / 3.;
constexpr int kFewestOutside = 3;

bool isWithin(const Plane8& mask, const Eigen::Vector2d& place, double beside_px) {
  const auto clamped = [](double at, Eigen::Index size) {
    return static_cast<int>(std::clamp(std::round(at), 0., static_cast<double>(size - 1)));
  };
  const int left = clamped(place.x() - beside_px, mask.cols()),
            right = clamped(place.x() + beside_px, mask.cols()),
            top = clamped(place.y() - beside_px, mask.rows()),
            bottom = clamped(place.y() + beside_px, mask.rows());
  return (mask.block(top, left, bottom - top + 1, right - left + 1) != 0).any();
}

}  // namespace

std::string jointsOutsideMask(const LabelFile& labels, const SkeletonTemplate& body_plan,
                              const std::string& mask_path) {
  const Plane8 mask = readMask(mask_path);
  const PixelBox figure = figureBox(mask);
  const double beside_px = kBeside * std::max(figure.width(), figure.height());
  int known = 0, outside = 0;
  for (const auto& [name, place] : labels.joints) {
    const int joint = body_plan.find(name);
    if (!place || joint < 0 || body_plan.joints[static_cast<size_t>(joint)].derived) continue;
    ++known;
    outside += !isWithin(mask, *place, beside_px);
  }
  if (outside < kFewestOutside || outside <= kMostOutside * known) return "";
  return std::to_string(outside) + " of " + std::to_string(known) + " joints lie outside the mask " +
         std::filesystem::path(mask_path).filename().string();
}

std::string jointFarOutsideFigure(const LabelFile& labels, const Plane8& mask) {
  Skeleton placed;
  for (const auto& [name, place] : labels.joints) {
    if (!place || !labels.isPlaced(name)) continue;
    Joint& joint = placed.joints.emplace_back();
    joint.name = name;
    joint.image = *place;
  }
  const Joint* far = jointFarOutside(placed, mask);
  return far ? "joints." + far->name +
                   ": lies far outside of the figure; place it on the figure, or, where that lacks a part, "
                   "mend its mask (skel-label, key M)"
             : "";
}

std::optional<JointClass> classWithoutCandidate(const LabelFile& labels, const SkeletonTemplate& body_plan) {
  const auto isPlaced = [&](int joint) {
    const std::string& name = body_plan.joints[static_cast<size_t>(joint)].name;
    return labels.isPlaced(name) && std::any_of(labels.joints.begin(), labels.joints.end(),
                                                [&](const auto& j) { return j.first == name && j.second; });
  };
  if (labels.labels.empty()) return std::nullopt;
  for (const TemplateLimb& limb : body_plan.limbs) {
    const auto isOther = [&](const std::optional<JointClass>& label) {
      return label && *label != limb.limb_class;
    };
    if (std::all_of(limb.joints.begin(), limb.joints.end(), isPlaced) &&
        std::all_of(labels.labels.begin(), labels.labels.end(), isOther))
      return limb.limb_class;
  }
  return std::nullopt;
}

}  // namespace skel
