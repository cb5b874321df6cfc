#include "libskel/image/formats.h"

#include <algorithm>
#include <cstdlib>

#include "libskel/core/error.h"
#include "libskel/image/read_image.h"

namespace skel {
namespace {

// Reads integers of either byte order; past the end they are 0.
class Bytes {
 public:
  Bytes(std::string_view bytes, bool big_endian) : bytes_(bytes), big_endian_(big_endian) {}

  std::uint32_t integer(std::size_t offset, int size) const {
    if (offset > bytes_.size() || bytes_.size() - offset < static_cast<std::size_t>(size)) return 0;
    std::uint32_t value = 0;
    for (int i = 0; i < size; ++i) {
      const auto byte = static_cast<std::uint8_t>(bytes_[offset + i]);
      value |= static_cast<std::uint32_t>(byte) << 8 * (big_endian_ ? size - 1 - i : i);
    }
    return value;
  }

 private:
  std::string_view bytes_;
  bool big_endian_;
};

// The first value of an integer tag in the first directory of a TIFF structure, 0 where there is none.
std::uint32_t tiffTag(std::string_view tiff, std::uint32_t tag) {
  constexpr std::uint32_t kShort = 3, kLong = 4;
  const Bytes bytes(tiff, tiff.starts_with("MM"));
  const std::size_t directory = bytes.integer(4, 4);
  const std::uint32_t count = bytes.integer(directory, 2);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::size_t entry = directory + 2 + 12 * std::size_t{i};
    if (entry + 12 > tiff.size()) break;
    if (bytes.integer(entry, 2) != tag) continue;
    const std::uint32_t type = bytes.integer(entry + 2, 2);
    // Of several values that do not fit here, the first one lies elsewhere.
    const int size = type == kShort ? 2 : type == kLong ? 4 : 0;
    const bool fits = size * std::uint64_t{bytes.integer(entry + 4, 4)} <= 4;
    return bytes.integer(fits ? entry + 8 : bytes.integer(entry + 8, 4), size);
  }
  return 0;
}

}  // namespace

Format formatOf(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return Format::kPng;
  if (bytes.starts_with("\xff\xd8\xff")) return Format::kJpeg;
  if (bytes.size() >= 16 && bytes.starts_with("RIFF") && bytes.substr(8, 4) == "WEBP") return Format::kWebp;
  if (bytes.starts_with("BM") && bytes.size() >= 26) return Format::kBmp;
  if (bytes.starts_with(std::string_view("II*\0", 4)) || bytes.starts_with(std::string_view("MM\0*", 4))) {
    return Format::kTiff;
  }
  if (bytes.starts_with("GIF87a") || bytes.starts_with("GIF89a")) return Format::kGif;
  if (bytes.size() >= 12 && bytes.substr(4, 4) == "ftyp") {
    const std::string_view brand = bytes.substr(8, 4);
    if (brand == "avif" || brand == "avis") return Format::kAvif;
    for (const char* heic : {"heic", "heix", "heim", "heis", "hevc", "hevx", "mif1", "msf1"}) {
      if (brand == heic) return Format::kHeic;
    }
  }
  return Format::kUnknown;
}

void checkSize(std::int64_t width, std::int64_t height, const std::string& file) {
  if (width <= 0 || height <= 0) throw InputError(file, "is a picture without pixels");
  if (width > kLongestSide_px || height > kLongestSide_px || width * height > kMaxPixels) {
    throw InputError(file, "is too large: " + std::to_string(width) + "x" + std::to_string(height) +
                               " px; make it smaller than 10000x10000");
  }
}

HeaderSize headerSize(std::string_view bytes, Format format) {
  const Bytes little(bytes, false);
  const auto magnitude = [](std::uint32_t value) {
    return std::abs(std::int64_t{static_cast<std::int32_t>(value)});
  };
  switch (format) {
    case Format::kBmp:
      if (little.integer(14, 4) == 12) return {little.integer(18, 2), little.integer(20, 2)};
      return {magnitude(little.integer(18, 4)), magnitude(little.integer(22, 4))};
    case Format::kGif:
      return {little.integer(6, 2), little.integer(8, 2)};
    case Format::kTiff:
      return {tiffTag(bytes, 256), tiffTag(bytes, 257)};
    case Format::kWebp: {
      const std::string_view chunk = bytes.substr(12, 4);
      if (chunk == "VP8X") return {little.integer(24, 3) + 1, little.integer(27, 3) + 1};
      if (chunk == "VP8L") {
        const std::uint32_t bits = little.integer(21, 4);
        return {(bits & 0x3fff) + 1, (bits >> 14 & 0x3fff) + 1};
      }
      return {little.integer(26, 2) & 0x3fff, little.integer(28, 2) & 0x3fff};
    }
    default:
      return {};
  }
}

int tiffBitsPerSample(std::string_view tiff) { return static_cast<int>(tiffTag(tiff, 0x0102)); }

int tiffOrientation(std::string_view tiff) {
  const std::uint32_t orientation = tiffTag(tiff, 0x0112);
  return orientation >= 1 && orientation <= 8 ? static_cast<int>(orientation) : 1;
}

int webpOrientation(std::string_view bytes) {
  const Bytes little(bytes, false);
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::size_t size = little.integer(at + 4, 4);
    if (bytes.substr(at, 4) == "EXIF") {
      std::string_view exif = bytes.substr(at + 8, size);
      if (exif.starts_with(std::string_view("Exif\0\0", 6))) exif.remove_prefix(6);
      return tiffOrientation(exif);
    }
    at += 8 + size + size % 2;
  }
  return 1;
}

std::optional<WebpFrame> firstWebpFrame(std::string_view bytes) {
  constexpr std::uint32_t kAnimated = 0x02, kFrameHeader = 16;
  const Bytes little(bytes, false);
  if (bytes.substr(12, 4) != "VP8X" || !(little.integer(20, 1) & kAnimated)) return std::nullopt;
  const auto chunkSize = [&](std::size_t at) {
    const std::size_t size = little.integer(at + 4, 4);
    return 8 + size + size % 2;
  };
  std::size_t at = 12;
  while (at + 8 <= bytes.size() && bytes.substr(at, 4) != "ANMF") at += chunkSize(at);
  if (at + 8 + kFrameHeader > bytes.size()) return std::nullopt;
  const std::size_t header = at + 8, end = std::min(at + chunkSize(at), bytes.size());
  std::string alpha, pixels;
  for (at = header + kFrameHeader; at + 8 <= end; at += chunkSize(at)) {
    const std::string_view name = bytes.substr(at, 4),
                           chunk = bytes.substr(at, std::min(chunkSize(at), end - at));
    if (name == "ALPH") alpha = chunk;
    if (name == "VP8 " || name == "VP8L") pixels = chunk;
  }
  if (pixels.empty()) return std::nullopt;
  WebpFrame frame;
  frame.x = static_cast<int>(2 * little.integer(header, 3));
  frame.y = static_cast<int>(2 * little.integer(header + 3, 3));
  std::string content = "WEBP";
  if (!alpha.empty())  // goes with an extended header: a flag that there is alpha, and the size
    content += std::string("VP8X\x0A\0\0\0\x10\0\0\0", 12) + std::string(bytes.substr(header + 6, 6)) + alpha;
  content += pixels;
  frame.bytes = "RIFF";
  for (int i = 0; i < 4; ++i) frame.bytes += static_cast<char>(content.size() >> 8 * i & 0xFF);
  frame.bytes += content;
  return frame;
}

Image oriented(Image image, int orientation) {
  if (orientation <= 1 || orientation > 8) return image;
  const int w = image.width, h = image.height;
  const bool transposed = orientation >= 5;
  Image out(transposed ? h : w, transposed ? w : h);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      int sx = transposed ? y : x, sy = transposed ? x : y;
      if (orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8) sx = w - 1 - sx;
      if (orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7) sy = h - 1 - sy;
      std::copy_n(image.pixel(sx, sy), 4, out.pixel(x, y));
    }
  }
  return out;
}

}  // namespace skel
