#include "libskel/export/joint_names.h"

#include <algorithm>
#include <array>

#include "libskel/export/bone_ends.h"
#include "libskel/skeleton/joint_lookup.h"

namespace skel {

namespace {

struct Names {
  std::string_view skel, vrm, mixamo;
};

constexpr std::array<Names, 17> kNames = {{
    {"pelvis", "hips", "mixamorig:Hips"},
    {"body", "spine", "mixamorig:Spine"},
    {"neck", "neck", "mixamorig:Neck"},
    {"head", "head", "mixamorig:Head"},
    {"head_top", "head_top", "mixamorig:HeadTop_End"},
    {"left_shoulder", "leftUpperArm", "mixamorig:LeftArm"},
    {"left_elbow", "leftLowerArm", "mixamorig:LeftForeArm"},
    {"left_hand", "leftHand", "mixamorig:LeftHand"},
    {"right_shoulder", "rightUpperArm", "mixamorig:RightArm"},
    {"right_elbow", "rightLowerArm", "mixamorig:RightForeArm"},
    {"right_hand", "rightHand", "mixamorig:RightHand"},
    {"left_hip", "leftUpperLeg", "mixamorig:LeftUpLeg"},
    {"left_knee", "leftLowerLeg", "mixamorig:LeftLeg"},
    {"left_foot", "leftFoot", "mixamorig:LeftFoot"},
    {"right_hip", "rightUpperLeg", "mixamorig:RightUpLeg"},
    {"right_knee", "rightLowerLeg", "mixamorig:RightLeg"},
    {"right_foot", "rightFoot", "mixamorig:RightFoot"},
}};

}  // namespace

std::string exportedJointName(const std::string& joint, JointNaming naming) {
  if (naming == JointNaming::kSkel) return joint;
  for (const Names& names : kNames)
    if (names.skel == joint) return std::string(naming == JointNaming::kVrm ? names.vrm : names.mixamo);
  const std::string end = boneEndName("");
  if (joint.size() > end.size() && joint.ends_with(end))
    return boneEndName(exportedJointName(joint.substr(0, joint.size() - end.size()), naming));
  return joint;
}

bool namesFit(const Skeleton& skeleton, JointNaming naming) {
  if (naming == JointNaming::kSkel) return true;
  const JointLookup own(skeleton);
  return std::all_of(kNames.begin(), kNames.end(), [&](const Names& names) {
    return names.skel == "head_top" || own.find(names.skel) >= 0;
  });
}

std::vector<std::string> exportedJointNames(const Skeleton& skeleton, JointNaming naming) {
  const JointLookup own(skeleton);
  const bool fit = namesFit(skeleton, naming);
  std::vector<std::string> names;
  for (const Joint& joint : skeleton.joints) {
    std::string name = fit ? exportedJointName(joint.name, naming) : joint.name;
    names.push_back(own.find(name) < 0 ? std::move(name) : joint.name);
  }
  return names;
}

}  // namespace skel
