// Pictures as JPEG bytes, for pages that are to be small.
#pragma once

#include <optional>
#include <string>

#include "libskel/image/image.h"

namespace skel {

// `quality`: 1…100. Alpha is left out. Nothing where this build has no JPEG.
std::optional<std::string> encodeJpeg(const Image& image, int quality);

}  // namespace skel
