#include "libskel/animation/pose_hash.h"

#include <algorithm>
#include <cmath>

#include "libskel/core/sha256.h"

namespace skel {

std::string restPoseHash(const Skeleton& skeleton) {
  std::string text;
  for (const Joint& joint : skeleton.joints) {
    text += joint.name + "\n" + std::to_string(joint.parent);
    for (const double place : joint.position) text += " " + std::to_string(std::lround(place * 1000));
    text += "\n";
  }
  return sha256(text);
}

bool isRelativeTo(const Clip& clip, const Skeleton& skeleton) {
  return !clip.rest_pose.empty() && clip.rest_pose == restPoseHash(skeleton) &&
         std::all_of(clip.tracks.begin(), clip.tracks.end(),
                     [&](const JointTrack& track) { return skeleton.find(track.joint) >= 0; });
}

}  // namespace skel
