#include "libskel/image/sealed_png.h"

#include <zlib.h>

#include <cstdint>

#include "libskel/core/error.h"
#include "libskel/core/sha256.h"
#include "libskel/image/read_image.h"
#include "libskel/image/write_image.h"

namespace skel {
namespace {

constexpr std::string_view kSealStart("tEXtskel-pixels\0", 16);
constexpr std::size_t kHashDigits = 64, kHeaderEnd = 33;  // the signature and IHDR

std::string bigEndian(std::uint32_t number) {
  std::string bytes;
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(number >> shift & 0xff);
  return bytes;
}

std::uint32_t chunkCrc(const std::string& bytes) {
  return static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

std::string pixelHash(const Image& image) {
  const std::string_view pixels(reinterpret_cast<const char*>(image.rgba.data()),
                                static_cast<std::size_t>(image.rgba.size()));
  return sha256(std::to_string(image.width) + "x" + std::to_string(image.height) + sha256(pixels));
}

std::string sealed(std::string png, const Image& image) {
  const std::string chunk = std::string(kSealStart) + pixelHash(image);
  return png.insert(kHeaderEnd, bigEndian(static_cast<std::uint32_t>(chunk.size() - 4)) + chunk +
                                    bigEndian(chunkCrc(chunk)));
}

}  // namespace

std::string encodeSealedPng(const Image& image) { return sealed(encodePng(image), image); }

std::string encodeSealedPng(const Plane8& plane) {
  const std::string png = encodePng(plane);
  return sealed(png, decodeImage(png, ""));
}

bool isAsSealed(std::string_view bytes) {
  // Programs that keep texts may put them elsewhere.
  const std::size_t seal = bytes.find(kSealStart);
  if (seal == bytes.npos) return false;
  try {
    return bytes.substr(seal + kSealStart.size(), kHashDigits) == pixelHash(decodeImage(bytes, ""));
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace skel
