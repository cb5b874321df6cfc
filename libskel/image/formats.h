// Inside the room: one decoder a format, and what file headers tell before anything is allocated.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "libskel/image/image.h"

namespace skel {

enum class Format { kUnknown, kPng, kJpeg, kWebp, kBmp, kTiff, kGif, kHeic, kAvif };

// By the first bytes; the name of a file says nothing.
Format formatOf(std::string_view bytes);

// Throws InputError if a picture of this size is empty or too large to be read.
void checkSize(std::int64_t width, std::int64_t height, const std::string& file);

// The size that the header of a WebP, BMP, TIFF or GIF file states; 0×0 where it has none.
struct HeaderSize {
  std::int64_t width = 0, height = 0;
};
HeaderSize headerSize(std::string_view bytes, Format format);

// 0 where it states none.
int tiffBitsPerSample(std::string_view tiff);
// The Orientation tag (1…8) of a TIFF structure, which is what EXIF data is; 1 where there is none.
int tiffOrientation(std::string_view tiff);
// The same for the EXIF chunk of a WebP file.
int webpOrientation(std::string_view bytes);

// The first frame of an animated WebP, as a WebP of its own, and where it lies on the canvas, px. Nothing
// where the file is not animated, or damaged.
struct WebpFrame {
  std::string bytes;
  int x = 0, y = 0;
};
std::optional<WebpFrame> firstWebpFrame(std::string_view bytes);

// The picture as it is meant to be seen, given its Orientation tag.
Image oriented(Image image, int orientation);

Image decodePng(std::string_view bytes, const std::string& file);
Image decodeJpeg(std::string_view bytes, const std::string& file);
Image decodeByPlugin(std::string_view bytes, Format format, const std::string& file);

}  // namespace skel
