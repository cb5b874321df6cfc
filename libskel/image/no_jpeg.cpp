#include "libskel/core/error.h"
#include "libskel/image/formats.h"
#include "libskel/image/write_jpeg.h"

namespace skel {

Image decodeJpeg(std::string_view, const std::string& file) {
  throw UnavailableError(file + ": this build reads no JPEG; convert the picture to PNG");
}

std::optional<std::string> encodeJpeg(const Image&, int) { return std::nullopt; }

}  // namespace skel
