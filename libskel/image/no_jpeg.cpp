#include "libskel/core/error.h"
#include "libskel/image/formats.h"

namespace skel {

Image decodeJpeg(std::string_view, const std::string& file) {
  throw UnavailableError(file + ": this build reads no JPEG; convert the picture to PNG");
}

}  // namespace skel
