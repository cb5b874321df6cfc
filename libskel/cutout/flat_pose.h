// A pose in space, laid limb by limb into the picture plane, as cut-out animation does: bones turn, and keep
// the length that they were drawn with.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "libskel/deform/skin_vertices.h"
#include "libskel/skeleton/template.h"

namespace skel {

// How each joint of a skeleton moves its part of the drawing: about `rest`, by `turn_rad` counter-clockwise,
// to `place`. Model frame, m, x to the right and y up.
struct FlatPose {
  std::vector<Eigen::Vector2d> rest, place;
  std::vector<double> turn_rad;

  Eigen::Vector2d moved(std::size_t joint, const Eigen::Vector2d& p) const;
};

// Each bone points where the posed one does as seen by the viewer, turned with its parent where it rather
// points at him. The feet that are down stand where they do in space: the whole figure is moved so.
FlatPose flatPose(const Skeleton& skeleton, const SkeletonTemplate& body_plan,
                  const JointTransforms& posed_from_rest);
// The same of a pose that is flat: each joint at its place, one a joint, model frame.
FlatPose flatPose(const Skeleton& skeleton, const SkeletonTemplate& body_plan,
                  std::vector<Eigen::Vector2d> places);

// The pose with bones turned by less, those of legs by the share `legs` and others by `rest`, 0 to 1, against
// what they hang on. Its lowest foot stays as low as it is.
FlatPose calmed(const FlatPose& pose, const Skeleton& skeleton, const SkeletonTemplate& body_plan,
                double legs, double rest);

}  // namespace skel
