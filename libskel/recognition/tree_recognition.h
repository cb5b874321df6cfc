// The default recogniser: a net that sees the whole figure, and a tree search in what it says.
#pragma once

#include <string>
#include <vector>

#include "libskel/image/image.h"
#include "libskel/jointnet/joint_net.h"
#include "libskel/jointnet/tree_recognizer.h"
#include "libskel/recognition/recognition.h"
#include "libskel/silhouette/silhouette.h"
#include "libskel/skeleton/template.h"

namespace skel {

// Joints of a confidence below this are named in Recognition::missing: they stand where the rest of the
// figure suggests, more likely wrong than right.
inline constexpr double kFoundConfidence = 0.5;

// `silhouette` must be found and belong to `image`, whose inner lines show limbs before the body. `body_plan`
// must have the joints that the net knows; throws UsageError otherwise.
Recognition recognizeByTree(const Image& image, const Silhouette& silhouette,
                            const SkeletonTemplate& body_plan, const JointNet& net,
                            const TreeRecognizerOptions& options = {});

}  // namespace skel
