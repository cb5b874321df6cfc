#include "libskel/skeleton/hanging.h"

#include <string_view>

namespace skel {
namespace {

constexpr std::string_view kHanging = "hanging_";

}  // namespace

std::string hangingJointName(const std::string& what, int link) {
  return std::string(kHanging) + what + "_" + std::to_string(link);
}

bool hangs(const Joint& joint) { return joint.name.starts_with(kHanging); }

int carrierOf(const Skeleton& skeleton, int joint) {
  const auto at = [&](int j) -> const Joint& { return skeleton.joints[static_cast<std::size_t>(j)]; };
  while (hangs(at(joint)) && at(joint).parent >= 0) joint = at(joint).parent;
  return joint;
}

Skeleton withoutHanging(const Skeleton& skeleton) {
  Skeleton result = skeleton;
  std::erase_if(result.joints, hangs);
  return result;
}

}  // namespace skel
