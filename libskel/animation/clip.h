// Motion: rotations of joints over time.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "libskel/skeleton/skeleton.h"

namespace skel {

struct JointTrack {
  std::string joint;           // by name
  std::vector<float> times_s;  // ascending, first is 0
  // Local to the parent, one for each time; identity: the rest pose. Between two of them: slerp.
  std::vector<Eigen::Quaternionf> rotations;
  // Where the joint's bone points, in the model frame, when all rotations are the identity (a unit vector):
  // retargetToRest() makes the bone of another rest pose point where this one would. Zero: the rotations are
  // added to whatever the rest pose is.
  Eigen::Vector3f bone = Eigen::Vector3f::Zero();
};

// A motion for the canonical pose (arms at the sides, legs straight), or, after retargetToRest(), for a drawn
// one.
struct Clip {
  std::string name;
  std::vector<JointTrack> tracks;
  std::vector<float> root_times_s;  // empty: the root stays
  // Added to the root's rest position, in units of the model's height.
  std::vector<Eigen::Vector3f> root_translations;
  // The first and the last so many seconds lead from the rest pose into the motion and back. 0: the clip
  // never comes to the rest pose (a walk).
  float lead_s = 0;

  float duration_s() const;
};

}  // namespace skel
