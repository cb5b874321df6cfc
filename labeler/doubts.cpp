#include "labeler/doubts.h"

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/sha256.h"
#include "libskel/mended/mend_places.h"
#include "libskel/mended/mended_files.h"

namespace skel {

std::vector<std::string> doubtsOf(const DrawingFiles& files) {
  try {
    MendRequest request;
    request.source = files.image;
    request.image_sha256 = sha256(readFile(files.image));
    for (const MendPlace& place : mendPlaces(request))
      if (place.is_of_picture) return place.result->warnings;
  } catch (const InputError&) {
  }
  return {};
}

}  // namespace skel
