// Whether what was found of a limb is one: a small net that has learned it from drawings whose limbs are
// known (skel-train limbs).
#pragma once

#include <string>
#include <string_view>

#include "libskel/core/logistic_net.h"
#include "libskel/layers/limb_evidence.h"

namespace skel {

// From which chance on a limb is one.
inline constexpr double kIsLimb = .5;

struct LimbNet {
  // Of kLimbInputs: that the limb is more true than not, with its hand or foot.
  LogisticNet net;
  std::string provenance;  // how the numbers came to be, for people

  double isLimb(const LimbEvidence& evidence) const;  // 0 where nothing was found
};

// Files of format "skel-limb-net". Throws InputError.
LimbNet parseLimbNet(std::string_view text, const std::string& file);
std::string formatLimbNet(const LimbNet& net);

// weights/limb_net.json, compiled in.
const LimbNet& builtInLimbNet();

}  // namespace skel
