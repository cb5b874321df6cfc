// How deep each part of a drawn figure is, by its bones.
#pragma once

#include "libskel/mesh/body_depth.h"
#include "libskel/silhouette/silhouette.h"
#include "libskel/skeleton/template.h"

namespace skel {

// `skeleton`: the template's joints, image px; of a limb that it lacks nothing is said, without the trunk's
// or the head's joints nothing at all. Limbs are numbered from 1; `far`: those that are known to be the
// farther ones of their pairs; `cut`: those that are pieces of their own, which are laid over one another and
// stand apart by that. `parts`: LayerMap::part.
BodyDepth bodyDepth(const Skeleton& skeleton, const SkeletonTemplate& body_plan, const Silhouette& silhouette,
                    const std::vector<int>& far = {}, const std::vector<int>& cut = {},
                    const Plane8& parts = {});

}  // namespace skel
