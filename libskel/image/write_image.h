// Pictures as PNG bytes, to be embedded or handed to writeFile().
#pragma once

#include <string>

#include "libskel/image/image.h"

namespace skel {

// 8-bit RGBA, or RGB if every pixel is opaque. `compression` as in zlib, 0…9.
std::string encodePng(const Image& image, int compression = 3);

// 8-bit grey.
std::string encodePng(const Plane8& plane, int compression = 6);

}  // namespace skel
