#include "libskel/jointnet/net_joints.h"

#include <algorithm>

#include "libskel/core/error.h"

namespace skel {
namespace {

// From each joint of the template the next one on the way to its body: the tree hung up at that joint.
std::vector<int> towardsBody(const SkeletonTemplate& body_plan) {
  std::vector<int> next;
  for (const TemplateJoint& joint : body_plan.joints) next.push_back(joint.parent);
  for (int joint = body_plan.body, from = -1; joint >= 0;) {
    const int parent = body_plan.joints[static_cast<size_t>(joint)].parent;
    next[static_cast<size_t>(joint)] = from;
    from = joint;
    joint = parent;
  }
  return next;
}

bool isFound(const SkeletonTemplate& body_plan, const std::string& joint) {
  const int index = body_plan.find(joint);
  return index >= 0 && !body_plan.joints[static_cast<size_t>(index)].derived;
}

}  // namespace

NetJoints netJoints(const std::vector<std::string>& names, const SkeletonTemplate& body_plan) {
  NetJoints joints;
  joints.names = names;
  const size_t count = names.size();
  std::vector<int> in_template, of_template(body_plan.joints.size(), -1);
  for (size_t j = 0; j < count; ++j) {
    const int index = body_plan.find(names[j]);
    if (!isFound(body_plan, names[j]))
      throw UsageError("the template \"" + body_plan.name + "\" has no joint \"" + names[j] +
                       "\" that could be found in a drawing");
    in_template.push_back(index);
    of_template[static_cast<size_t>(index)] = static_cast<int>(j);
  }
  if (of_template[static_cast<size_t>(body_plan.body)] < 0)
    throw UsageError("the net does not find the body joint of the template \"" + body_plan.name + "\"");

  const std::vector<int> next = towardsBody(body_plan);
  for (size_t j = 0; j < count; ++j) {
    int up = next[static_cast<size_t>(in_template[j])];
    while (up >= 0 && of_template[static_cast<size_t>(up)] < 0) up = next[static_cast<size_t>(up)];
    joints.parent.push_back(up < 0 ? -1 : of_template[static_cast<size_t>(up)]);
    const int mirror =
        of_template[static_cast<size_t>(body_plan.joints[static_cast<size_t>(in_template[j])].mirror)];
    if (mirror < 0)
      throw UsageError("the net finds \"" + names[j] + "\" but not its counterpart of the other side");
    joints.mirrored.push_back(mirror);
  }
  std::vector<bool> placed(count, false);
  while (joints.order.size() < count) {
    for (size_t j = 0; j < count; ++j) {
      const int parent = joints.parent[j];
      if (placed[j] || (parent >= 0 && !placed[static_cast<size_t>(parent)])) continue;
      placed[j] = true;
      joints.order.push_back(static_cast<int>(j));
    }
  }

  const auto preset = [&](int joint) {
    return body_plan.joints[static_cast<size_t>(in_template[static_cast<size_t>(joint)])].preset;
  };
  std::vector<int> limb(count, -1);  // that a joint belongs to
  for (const int j : joints.order) {
    const auto at = static_cast<size_t>(j);
    const int other = joints.mirrored[at], parent = joints.parent[at];
    if (other == j) continue;
    if (parent >= 0 && joints.mirrored[static_cast<size_t>(parent)] != parent) {
      limb[at] = limb[static_cast<size_t>(parent)];
    } else if (preset(j).x() > preset(other).x()) {
      limb[at] = static_cast<int>(joints.limbs.size());
      joints.limbs.emplace_back();
    }
    if (limb[at] >= 0) joints.limbs[static_cast<size_t>(limb[at])].push_back(j);
  }
  return joints;
}

const JointNet* jointNetFor(const SkeletonTemplate& body_plan, const JointNets& nets) {
  const auto knows = [&](std::string_view name) {
    const std::vector<std::string>& joints = nets.of(name).joints;
    return std::all_of(joints.begin(), joints.end(),
                       [&](const std::string& joint) { return isFound(body_plan, joint); });
  };
  // That of the same name first, since to read a net takes time.
  if (nets.has(body_plan.name) && knows(body_plan.name)) return &nets.of(body_plan.name);
  const auto names = nets.bodyPlans();
  const auto other = std::find_if(names.begin(), names.end(), knows);
  return other == names.end() ? nullptr : &nets.of(*other);
}

}  // namespace skel
