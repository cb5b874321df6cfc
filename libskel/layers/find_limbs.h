// The limbs of a recognised figure, and what speaks for each.
#pragma once

#include <array>
#include <optional>

#include "libskel/layers/find_parts.h"
#include "libskel/layers/limb_evidence.h"
#include "libskel/silhouette/silhouette.h"
#include "libskel/skeleton/skeleton.h"
#include "libskel/skeleton/template.h"

namespace skel {

struct FoundLimbs {
  PartPicture picture;
  PartSkeleton skeleton;
  LimbConfidences confidences;
  std::array<LimbBorder, 4> borders;  // in the template's order
};

// `skeleton` in image px. Nothing for a body plan that the net does not know (knowsParts()), or where the
// skeleton lacks a joint of it.
std::optional<FoundLimbs> findLimbs(const Image& image, const Silhouette& silhouette,
                                    const Skeleton& skeleton, const SkeletonTemplate& body_plan,
                                    const PartNet& net);

LimbEvidence limbEvidence(const FoundLimbs& found, int limb);

}  // namespace skel
