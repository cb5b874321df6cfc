// The joints of a skeleton by name, for where many are looked for.
#pragma once

#include <string_view>
#include <unordered_map>

#include "libskel/skeleton/skeleton.h"

namespace skel {

class JointLookup {
 public:
  // The skeleton must outlive it, its names unchanged.
  explicit JointLookup(const Skeleton& skeleton) {
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
      numbers_.emplace(skeleton.joints[j].name, static_cast<int>(j));
  }
  // As Skeleton::find().
  int find(std::string_view name) const {
    const auto found = numbers_.find(name);
    return found == numbers_.end() ? -1 : found->second;
  }

 private:
  std::unordered_map<std::string_view, int> numbers_;
};

}  // namespace skel
