// A clip at one moment.
#pragma once

#include "libskel/animation/clip.h"

namespace skel {

struct Pose {
  std::vector<Eigen::Quaternionf> rotations;  // one a joint, local to the parent; identity: the rest pose
  Eigen::Vector3f root_translation = Eigen::Vector3f::Zero();  // in units of the model's height
};

// Times before the first and after the last key hold that key. Throws UsageError if the clip moves a joint
// that the skeleton lacks.
Pose samplePose(const Clip& clip, const Skeleton& skeleton, float time_s);

}  // namespace skel
