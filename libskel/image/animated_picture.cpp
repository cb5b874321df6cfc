#include "libskel/image/animated_picture.h"

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/image/formats.h"

namespace skel {
namespace {

bool hasTwoGifFrames(std::string_view gif) {
  constexpr std::size_t kHeader = 13, kImageHeader = 10;
  const auto byte = [&](std::size_t at) {
    return at < gif.size() ? static_cast<unsigned char>(gif[at]) : std::size_t{0};
  };
  const auto colours = [&](std::size_t flags) {
    return flags & 0x80 ? std::size_t{3} << ((flags & 7) + 1) : std::size_t{0};
  };
  int frames = 0;
  for (std::size_t at = kHeader + colours(byte(10)); at < gif.size();) {
    if (gif[at] == '!')
      at += 2;
    else if (gif[at] != ',')
      return false;
    else if (++frames == 2)
      return true;
    else
      at += kImageHeader + colours(byte(at + kImageHeader - 1)) + 1;
    while (byte(at) > 0) at += 1 + byte(at);  // blocks of data, of which the last is empty
    ++at;
  }
  return false;
}

}  // namespace

bool isAnimatedPicture(const std::string& path) {
  try {
    const std::string bytes = readFile(path);
    const Format format = formatOf(bytes);
    return format == Format::kGif ? hasTwoGifFrames(bytes)
                                  : format == Format::kWebp && firstWebpFrame(bytes).has_value();
  } catch (const Error&) {
    return false;
  }
}

}  // namespace skel
