#include "libskel/core/error.h"
#include "libskel/image/formats.h"

namespace skel {

Image decodeByPlugin(std::string_view, Format, const std::string& file) {
  throw UnavailableError(file + ": this build reads no WebP, BMP, TIFF and GIF; convert the picture to PNG");
}

}  // namespace skel
