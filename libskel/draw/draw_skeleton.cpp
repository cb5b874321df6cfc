#include "libskel/draw/draw_skeleton.h"

#include <algorithm>

namespace skel {

void drawSkeleton(Image& image, const Skeleton& skeleton, const SkeletonStyle& style) {
  if (skeleton.joints.empty()) return;
  Eigen::Vector2d low = skeleton.joints[0].image, high = low;
  for (const Joint& joint : skeleton.joints)
    low = low.cwiseMin(joint.image), high = high.cwiseMax(joint.image);
  const double width = style.bone_px > 0 ? style.bone_px : std::max(1.5, (high - low).maxCoeff() / 100);
  const double radius = 1.5 * width, rim = 0.5 * width;

  // A light rim below everything keeps it visible on dark drawings, the colours do so on light ones.
  for (const Joint& joint : skeleton.joints) {
    if (joint.parent >= 0)
      drawLine(image, skeleton.joints[joint.parent].image, joint.image, width + 2 * rim, kWhite);
    drawDisc(image, joint.image, radius + rim, kWhite);
  }
  for (const Joint& joint : skeleton.joints)
    if (joint.parent >= 0)
      drawLine(image, skeleton.joints[joint.parent].image, joint.image, width, sideColor(joint.name));
  for (const Joint& joint : skeleton.joints) {
    drawDisc(image, joint.image, radius, sideColor(joint.name));
    if (joint.confidence < style.low_confidence) drawDisc(image, joint.image, 0.55 * radius, kWhite);
  }
}

}  // namespace skel
