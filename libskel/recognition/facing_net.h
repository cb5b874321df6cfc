// Which way a two-legged figure looks, learned from drawings of which a person has said it (skel-train
// facing).
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

#include "libskel/core/logistic_net.h"
#include "libskel/recognition/facing_evidence.h"
#include "libskel/skeleton/facing.h"

namespace skel {

struct FacingNet {
  LogisticNet right;       // of kSidedInputs: that it looks to the right, not to the left
  LogisticNet turned;      // of turnInputs(): that it is turned to a side by half at least
  LogisticNet side;        // of turnInputs(): that it is seen from the side
  std::string provenance;  // how the numbers came to be, for people

  // In steps of pi / 4; of a mirror image the same with the other sign.
  Facing of(const FacingEvidence& evidence) const;
};

// kSidedInputs without their signs, then kUnsidedInputs.
Eigen::VectorXd turnInputs(const FacingEvidence& evidence);

// Files of format "skel-facing-net". Throws InputError.
FacingNet parseFacingNet(std::string_view text, const std::string& file);
std::string formatFacingNet(const FacingNet& net);

// weights/facing_net.json, compiled in.
const FacingNet& builtInFacingNet();

}  // namespace skel
