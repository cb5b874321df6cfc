// From the joints that were found to a whole skeleton that lies on the figure.
#pragma once

#include <vector>

#include "libskel/silhouette/silhouette.h"
#include "libskel/skeleton/skeleton.h"
#include "libskel/skeleton/template.h"

namespace skel {

// Fills in the joints that were not found from the template's preset in the figure's box, moved as the found
// ones around them differ from their presets; derives what the template derives; moves joints that coincide
// apart (Shu & Yang 2018) and all of them onto the figure. `skeleton` has the template's joints in image px;
// `found` has one entry for each.
void completeSkeleton(Skeleton& skeleton, const std::vector<bool>& found, const SkeletonTemplate& body_plan,
                      const Silhouette& silhouette);

}  // namespace skel
