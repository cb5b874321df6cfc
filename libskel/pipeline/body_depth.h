// How deep each part of a drawn figure is, by its bones.
#pragma once

#include "libskel/mesh/body_depth.h"
#include "libskel/silhouette/silhouette.h"
#include "libskel/skeleton/template.h"

namespace skel {

// `skeleton`: the template's joints, image px; of a limb that it lacks nothing is said, without the trunk's
// or the head's joints nothing at all.
BodyDepth bodyDepth(const Skeleton& skeleton, const SkeletonTemplate& body_plan,
                    const Silhouette& silhouette);

}  // namespace skel
