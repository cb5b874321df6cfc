#include "libskel/core/error.h"
#include "libskel/layers/find_parts.h"

namespace skel {

// Looking for parts takes more of OpenCV than the build for browsers has.
PartPicture findParts(const Image&, const Plane8&, const PartSkeleton&, const PartNet&) {
  throw UnavailableError("parts cannot be told here");
}

}  // namespace skel
