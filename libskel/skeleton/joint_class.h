// The kinds of joints that the classifier tells apart and a template gives to its bones.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace skel {

enum class JointClass { kHead = 0, kBody = 1, kHand = 2, kLeg = 3 };
inline constexpr int kJointClassCount = 4;
inline constexpr std::array<const char*, kJointClassCount> kJointClassNames = {"head", "body", "hand", "leg"};

// Nothing: no class has this name.
inline std::optional<JointClass> jointClassNamed(std::string_view name) {
  const auto* found = std::find(kJointClassNames.begin(), kJointClassNames.end(), name);
  if (found == kJointClassNames.end()) return std::nullopt;
  return static_cast<JointClass>(found - kJointClassNames.begin());
}

}  // namespace skel
