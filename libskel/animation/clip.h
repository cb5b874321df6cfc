// Motion: rotations, places and sizes of joints over time.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "libskel/skeleton/skeleton.h"

namespace skel {

// How a joint turns between two keys.
enum class RotationInterpolation {
  kSlerp,   // evenly about one axis, the shorter way
  kAngles,  // each of JointTrack::angles_rad by itself, so that turns beyond half a circle are made
};

// What one joint does. Each of the three kinds of keys has times of its own, ascending, and may be empty:
// then the joint keeps what it has in the rest pose. One key at least in all.
struct JointTrack {
  std::string joint;  // by name
  std::vector<float> times_s;
  // Local to the parent, one for each time; identity: the rest pose.
  std::vector<Eigen::Quaternionf> rotations;
  // Where the joint's bone points, in the model frame, when all rotations are the identity (a unit vector):
  // retargetToRest() makes the bone of another rest pose point where this one would. Zero: the rotations are
  // added to whatever the rest pose is.
  Eigen::Vector3f bone = Eigen::Vector3f::Zero();
  // So far the bone may stay away from there, on the side where it was drawn.
  float slack_rad = 0;
  // The rotations as angles (x, y, z) with R = Rz · Ry · Rx, one for each time, where the file gives them so;
  // else empty.
  std::vector<Eigen::Vector3f> angles_rad = {};
  std::vector<float> translation_times_s = {};
  // Added to the joint's rest place in its parent, in m.
  std::vector<Eigen::Vector3f> translations_m = {};
  std::vector<float> scale_times_s = {};
  std::vector<Eigen::Vector3f> scales = {};  // along the joint's own axes, before it is turned

  bool operator==(const JointTrack&) const = default;
};

// While a foot stands on the ground.
struct FootContact {
  std::string joint;
  float from_s = 0, to_s = 0;

  bool operator==(const FootContact&) const = default;
};

// The directions that a motion keeps to.
enum class ClipFrame {
  kPicture,  // those of the picture, whatever the figure looks at (a wave)
  // The figure's own: made for a biped that faces the viewer and for a quadruped that looks to the left,
  // turned about the vertical for others (a walk).
  kBody,
};

// A motion for the canonical pose (arms at the sides, legs straight), or, after retargetToRest(), for a drawn
// one.
struct Clip {
  std::string name;
  std::string template_name;  // of the body plan that it is made for; empty: whatever has its joints
  std::vector<JointTrack> tracks;
  std::vector<float> root_times_s;  // empty: the root stays
  // Added to the root's rest position, in units of the model's height, so that they fit every character.
  std::vector<Eigen::Vector3f> root_translations;
  // The first and the last so many seconds lead from the rest pose into the motion and back. 0: the clip
  // never comes to the rest pose (a walk).
  float lead_s = 0;
  // The clip lasts at least so long; the last keys hold.
  float least_duration_s = 0;
  RotationInterpolation interpolation = RotationInterpolation::kSlerp;
  ClipFrame frame = ClipFrame::kPicture;
  std::vector<FootContact> contacts;  // retargetToRest() keeps these feet on the ground, and spends them
  bool loops = false;                 // its end leads to its beginning: games play it on and on
  // restPoseHash() of the one character whose rest pose the keys are relative to; empty: as is said above.
  std::string rest_pose = {};

  float duration_s() const;
  bool operator==(const Clip&) const = default;
};

// How much of the drawn pose is taken back at `time_s`: 0 at the ends of a clip that starts from rest
// (Clip::lead_s), else 1.
double canonicalShare(const Clip& clip, double time_s);

}  // namespace skel
