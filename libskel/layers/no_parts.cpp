#include "libskel/core/error.h"
#include "libskel/layers/layer_map.h"

namespace skel {

// Looking for parts takes more of OpenCV than the build for browsers has.
LayerMap findPartLayers(const Image&, const Silhouette&, const Skeleton&, const SkeletonTemplate&,
                        const PartNet&) {
  throw UnavailableError("parts cannot be told here");
}

}  // namespace skel
