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
  std::vector<Eigen::Quaternionf>
      rotations;  // local to the parent, one for each time; identity: the rest pose
};

// A motion for the canonical pose (arms at the sides, legs straight), or, after retargetToRest(), for a drawn
// one.
struct Clip {
  std::string name;
  std::vector<JointTrack> tracks;
  std::vector<float> root_times_s;  // empty: the root stays
  std::vector<Eigen::Vector3f>
      root_translations;  // added to the root's rest position, in units of the model's height

  float duration_s() const;
};

}  // namespace skel
