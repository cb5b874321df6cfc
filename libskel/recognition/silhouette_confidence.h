// How sure one may be of a silhouette that was found on a page that is not tidy: learned from pages whose
// figure is known (skel-train silhouettes), from what the page net says of the mask (mask_evidence.h).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "libskel/recognition/confidence_model.h"
#include "libskel/silhouette/silhouette.h"

namespace skel {

struct SilhouetteConfidence {
  LogisticNet net;         // of kMaskInputs
  std::string provenance;  // how the numbers came to be, for people

  // That the mask meets the figure with an intersection over union of at least .9, [0, 1].
  double of(const MaskEvidence& evidence) const;
};

// A mask is doubted that is wrong in more than one of three cases, by its confidence.
inline constexpr double kSureMask = 2. / 3;

// Where to look in a mask that is doubted, in one clause for people; nothing where it is not or where there
// is no evidence (Silhouette::evidence, ::enclosed).
std::optional<std::string> silhouetteDoubt(const Silhouette& silhouette,
                                           const SilhouetteConfidence& confidence);

// Files of format "skel-silhouette-confidence". Throws InputError.
SilhouetteConfidence parseSilhouetteConfidence(std::string_view text, const std::string& file);
std::string formatSilhouetteConfidence(const SilhouetteConfidence& confidence);

// weights/silhouette_confidence.json, compiled in.
const SilhouetteConfidence& builtInSilhouetteConfidence();

}  // namespace skel
