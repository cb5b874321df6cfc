#include "libskel/skeleton/hanging.h"

#include <string_view>
#include <vector>

namespace skel {
namespace {

constexpr std::string_view kHanging = "hanging_";

}  // namespace

std::string hangingJointName(const std::string& what, int link) {
  return std::string(kHanging) + what + "_" + std::to_string(link);
}

bool isHangingName(std::string_view joint) { return joint.starts_with(kHanging); }

bool hangs(const Joint& joint) { return isHangingName(joint.name); }

int carrierOf(const Skeleton& skeleton, int joint) {
  const auto at = [&](int j) -> const Joint& { return skeleton.joints[static_cast<std::size_t>(j)]; };
  while (hangs(at(joint)) && at(joint).parent >= 0) joint = at(joint).parent;
  return joint;
}

Skeleton withoutHanging(const Skeleton& skeleton) {
  Skeleton result = skeleton;
  result.joints.clear();
  std::vector<int> place;  // in the result, of each joint that stays
  for (const Joint& joint : skeleton.joints) {
    place.push_back(static_cast<int>(result.joints.size()));
    if (hangs(joint)) continue;
    result.joints.push_back(joint);
    if (joint.parent >= 0) result.joints.back().parent = place[static_cast<std::size_t>(joint.parent)];
  }
  return result;
}

}  // namespace skel
