#include "libskel/animation/mirror_clip.h"

namespace skel {
namespace {

std::string otherSide(const std::string& joint) {
  if (joint.starts_with("left_")) return "right_" + joint.substr(5);
  if (joint.starts_with("right_")) return "left_" + joint.substr(6);
  return joint;
}

}  // namespace

Clip mirrored(const Clip& clip) {
  Clip result = clip;
  for (JointTrack& track : result.tracks) {
    track.joint = otherSide(track.joint);
    track.bone.x() *= -1;
    for (Eigen::Quaternionf& rotation : track.rotations) rotation.y() *= -1, rotation.z() *= -1;
    for (Eigen::Vector3f& angles : track.angles_rad) angles.y() *= -1, angles.z() *= -1;
    for (Eigen::Vector3f& place : track.translations_m) place.x() *= -1;
  }
  for (Eigen::Vector3f& place : result.root_translations) place.x() *= -1;
  for (FootContact& contact : result.contacts) contact.joint = otherSide(contact.joint);
  return result;
}

}  // namespace skel
