// From where a figure is drawn, as its joints tell.
#pragma once

#include "libskel/skeleton/skeleton.h"
#include "libskel/skeleton/template.h"

namespace skel {

// 1: drawn from the front or from behind, 0: from the side; by the distance of its shoulders in the image as
// a share of its trunk's length. 1 where its joints don't tell.
double frontal(const Skeleton& skeleton, const SkeletonTemplate& body_plan);

}  // namespace skel
