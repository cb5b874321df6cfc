#include "libskel/export/joint_names.h"

#include <array>

#include "libskel/export/bone_ends.h"

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

}  // namespace skel
