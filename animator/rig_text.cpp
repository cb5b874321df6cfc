#include "animator/rig_text.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "libskel/animation/bone_turn.h"

namespace skel {

std::string formatRig(const Skeleton& skeleton) {
  constexpr double kTip = 0.5;  // of a leaf, as a share of the bone that leads to it
  nlohmann::ordered_json joints = nlohmann::ordered_json::array();
  nlohmann::ordered_json hierarchy = nlohmann::ordered_json::object();
  const std::vector<Eigen::Vector3d> bones = restBones(skeleton);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    Eigen::Vector3d tail = Eigen::Vector3d::Zero();
    int children = 0;
    for (const Joint& other : skeleton.joints)
      if (other.parent == int(j)) tail += other.position, ++children;
    if (joint.tail) {
      tail = *joint.tail;
    } else if (children > 0) {
      tail /= children;
    } else {
      const double length =
          joint.parent < 0 ? 1
                           : (joint.position - skeleton.joints[std::size_t(joint.parent)].position).norm();
      tail = joint.position + kTip * length * bones[j];
    }
    nlohmann::ordered_json entry;
    entry["name"] = joint.name;
    entry["index"] = j;
    entry["head"] = {joint.position.x(), joint.position.y(), joint.position.z()};
    entry["tail"] = {tail.x(), tail.y(), tail.z()};
    if (joint.parent < 0) {
      entry["parent"] = nullptr;
    } else {
      const std::string& parent = skeleton.joints[std::size_t(joint.parent)].name;
      entry["parent"] = parent;
      hierarchy[joint.name] = parent;
    }
    joints.push_back(std::move(entry));
  }
  const nlohmann::ordered_json document = {{"joints", std::move(joints)},
                                           {"hierarchy", std::move(hierarchy)}};
  return document.dump(1) + "\n";
}

int boneCount(const Skeleton& skeleton) {
  return static_cast<int>(std::count_if(skeleton.joints.begin(), skeleton.joints.end(),
                                        [](const Joint& joint) { return joint.parent >= 0; }));
}

std::vector<TreeLine> asTree(const Skeleton& skeleton) {
  constexpr std::size_t kStep = 2, kMost = 80;
  std::vector<std::vector<std::size_t>> children(skeleton.joints.size());
  std::vector<TreeLine> waiting, lines;  // the next one is the last that waits
  for (std::size_t j = skeleton.joints.size(); j-- > 0;)
    if (const int parent = skeleton.joints[j].parent; parent >= 0)
      children[std::size_t(parent)].push_back(j);
    else
      waiting.push_back({j, std::string(kStep, ' ')});
  while (!waiting.empty()) {
    lines.push_back(std::move(waiting.back()));
    waiting.pop_back();
    const TreeLine& line = lines.back();
    for (const std::size_t child : children[line.joint])
      waiting.push_back({child, std::string(std::min(line.spaces.size() + kStep, kMost), ' ')});
  }
  return lines;
}

}  // namespace skel
