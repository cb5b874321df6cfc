#include "libskel/skin/bones.h"

namespace skel {
namespace {

// Of the bone that leads to a leaf: how long the leaf's own tip is.
constexpr float kTip = 0.3f;

}  // namespace

std::vector<int> jointLimbs(const Skeleton& skeleton) {
  const int count = static_cast<int>(skeleton.joints.size());
  std::vector<int> children(count, 0), limbs(count, -1);
  for (const Joint& joint : skeleton.joints) {
    if (joint.parent >= 0) ++children[joint.parent];
  }
  for (int leaf = 0; leaf < count; ++leaf) {
    if (children[leaf] > 0) continue;
    for (int joint = leaf; joint > 0 && children[joint] < 2; joint = skeleton.joints[joint].parent)
      limbs[joint] = leaf;
  }
  return limbs;
}

std::vector<Bone> skeletonBones(const Skeleton& skeleton) {
  std::vector<Bone> bones;
  const std::vector<int> limbs = jointLimbs(skeleton);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    if (joint.tail)
      bones.push_back(
          {static_cast<int>(j), limbs[j], joint.position.cast<float>(), joint.tail->cast<float>()});
  }
  if (!bones.empty()) return bones;
  const int head = skeleton.find("head");
  const auto position = [&](int joint) -> Eigen::Vector3f {
    return skeleton.joints[joint].position.cast<float>();
  };
  const int count = static_cast<int>(skeleton.joints.size());
  for (int joint = 0; joint < count; ++joint) {
    const Eigen::Vector3f here = position(joint);
    const int parent = skeleton.joints[joint].parent;
    // A head nods as a whole: its bone begins half way from the neck, where its region (DESIGN's table of
    // classes) does, although it turns about its own middle.
    if (joint == head && parent >= 0)
      bones.push_back({joint, limbs[joint], 0.5f * (position(parent) + here), here});
    bool leaf = true;
    for (int child = joint + 1; child < count; ++child) {
      if (skeleton.joints[child].parent != joint) continue;
      leaf = false;
      const Eigen::Vector3f there = position(child);
      bones.push_back(
          {joint, limbs[joint], here, child == head ? Eigen::Vector3f(0.5f * (here + there)) : there});
    }
    if (!leaf) continue;
    const Eigen::Vector3f tip = parent < 0 ? here : Eigen::Vector3f(here + kTip * (here - position(parent)));
    bones.push_back({joint, limbs[joint], here, tip});
  }
  return bones;
}

bool nearlyFlat(const std::vector<Bone>& bones) {
  constexpr float kDeep = 0.25f;  // of the skeleton's size
  Eigen::Array3f low = bones[0].from, high = low;
  for (const Bone& bone : bones) {
    low = low.min(bone.from.array()).min(bone.to.array());
    high = high.max(bone.from.array()).max(bone.to.array());
  }
  const Eigen::Array3f size = high - low;
  return size.z() <= kDeep * size.maxCoeff();
}

}  // namespace skel
