// A clip at one moment.
#pragma once

#include <vector>

#include "libskel/animation/clip.h"

namespace skel {

struct Pose {
  std::vector<Eigen::Quaternionf> rotations;  // one a joint, local to the parent; identity: the rest pose
  Eigen::Vector3f root_translation = Eigen::Vector3f::Zero();  // in units of the model's height
  // One a joint, or empty where no joint is moved or scaled: added to the rest place in the parent, in m;
  // along the joint's own axes.
  std::vector<Eigen::Vector3f> translations_m = {};
  std::vector<Eigen::Vector3f> scales = {};
};

// R = Rz · Ry · Rx.
Eigen::Quaternionf rotationOfAngles(const Eigen::Vector3f& angles_rad);

// A clip for a skeleton, at any moments; both must outlive it.
class ClipSampler {
 public:
  // Throws UsageError if the clip moves a joint that the skeleton lacks.
  ClipSampler(const Clip& clip, const Skeleton& skeleton);
  // Times before the first and after the last key hold that key.
  Pose at(float time_s) const;

 private:
  const Clip& clip_;
  std::size_t joint_count_;
  std::vector<int> joints_;  // of the tracks
};

// At one moment. Throws as ClipSampler does.
Pose samplePose(const Clip& clip, const Skeleton& skeleton, float time_s);

// The same motion with slerp between keys of an even rate (tracks that are so already stay), for formats that
// know nothing else.
Clip withSlerp(const Clip& clip, float rate_hz = 30);

}  // namespace skel
