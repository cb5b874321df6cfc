// Pictures of all formats, by their first bytes.
#include "libskel/image/read_image.h"
#include "tests/fuzz/fuzz.h"

namespace skel {
namespace {

std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = 0xffffffffu;
  for (const char byte : bytes) {
    crc ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (0xedb88320u & (0u - (crc & 1u)));
  }
  return ~crc;
}

// Gives each chunk of a PNG its right checksum, so that what was changed in it is read at all.
std::string withRightChecksums(std::string png) {
  for (std::size_t at = 8; at + 12 <= png.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | static_cast<std::uint8_t>(png[at + i]);
    if (length > png.size() - at - 12) break;
    const std::uint32_t crc = crc32(std::string_view(png).substr(at + 4, length + 4));
    for (std::size_t i = 0; i < 4; ++i) png[at + 8 + length + i] = static_cast<char>(crc >> (24 - 8 * i));
    at += 12 + length;
  }
  return png;
}

}  // namespace
}  // namespace skel

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  std::string bytes(textOf(data, size));
  if (bytes.starts_with("\x89PNG")) bytes = withRightChecksums(std::move(bytes));
  mayRefuse([&] {
    const Image image = decodeImage(bytes, "fuzz");
    require(!image.empty(), "a picture that is read has pixels");
  });
  return 0;
}
