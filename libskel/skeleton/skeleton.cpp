#include "libskel/skeleton/skeleton.h"

#include "libskel/core/check.h"

namespace skel {

std::string_view jointOriginName(JointOrigin origin) {
  return kJointOriginNames[static_cast<size_t>(origin)];
}

int Skeleton::find(std::string_view name) const {
  for (size_t i = 0; i < joints.size(); ++i)
    if (joints[i].name == name) return static_cast<int>(i);
  return -1;
}

int Skeleton::index(std::string_view name) const {
  const int i = find(name);
  if (i < 0) checkFailed(__FILE__, __LINE__, "no joint named " + std::string(name));
  return i;
}

}  // namespace skel
