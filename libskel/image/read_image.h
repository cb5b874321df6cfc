// Picture files.
#pragma once

#include <string>
#include <string_view>

#include "libskel/image/image.h"

namespace skel {

// Reads PNG and JPEG directly; WebP and GIF (of animated ones the first frame), BMP and TIFF through a plugin
// that is loaded when such a file comes. Throws InputError (missing, empty, truncated, not a picture, CMYK,
// HEIC, more than kMaxPixels or kLongestSide_px) and UnavailableError (the plugin is not there).
Image readImage(const std::string& path);

// `file` is the name that complaints use.
Image decodeImage(std::string_view bytes, const std::string& file);

// A grey picture as a mask: 255 where the picture is at least 128 (and, if it has alpha, opaque), else 0.
Plane8 readMask(const std::string& path);
Plane8 decodeMask(std::string_view bytes, const std::string& file);

// Larger pictures are refused: they would need more than 1 GB, or are longer than what turns and bends
// pictures can count.
inline constexpr long kMaxPixels = 100'000'000;
inline constexpr int kLongestSide_px = 32'766;

}  // namespace skel
