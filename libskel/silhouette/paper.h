// The silhouette as in Y. Shu, X. Yang, "A fast skeleton extraction algorithm for 3D cartoon characters"
// (2018), §3.1: HSV, binarise V to get the lines, flood-fill the background from outside.
#pragma once

#include "libskel/image/image.h"

namespace skel {

// 255 where the flood fill does not come: lines and what they enclose. The paper does not give the threshold
// on V; here it is Otsu's.
Plane8 paperForeground(const Image& image);

}  // namespace skel
