// The joints that a net finds, in the order of its heatmaps, and how a body plan ties them together.
#pragma once

#include <string>
#include <vector>

#include "libskel/jointnet/joint_net.h"
#include "libskel/skeleton/template.h"

namespace skel {

struct NetJoints {
  std::vector<std::string> names;
  std::vector<int> mirrored;  // the same joint of the other side; itself if it lies in the middle
  // The joint next on the template's way to its body joint, over joints that are derived; -1 for the body.
  std::vector<int> parent;
  std::vector<int> order;  // all joints, parents before children
  // Of each pair of limbs, the joints of the one further right in the template's preset (the left one).
  std::vector<std::vector<int>> limbs;

  int count() const { return static_cast<int>(names.size()); }
};

// Throws UsageError if `body_plan` lacks one of the joints, or derives it from others, or if its body or a
// joint's counterpart is not among them.
NetJoints netJoints(const std::vector<std::string>& names, const SkeletonTemplate& body_plan);

// The net that knows a template of this name, or else one that finds joints which the template has; null if
// there is none.
const JointNet* jointNetFor(const SkeletonTemplate& body_plan, const JointNets& nets);

}  // namespace skel
