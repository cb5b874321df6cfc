#include "libskel/window/font.h"

#include <imgui.h>

#include <filesystem>

namespace skel {
namespace {

// Unicode, in pairs of first and last. Names from archives of a Mac have marks of their own behind letters.
constexpr ImWchar kLetters[] = {0x20,   0x58F,   // Latin, marks, Greek, Cyrillic, Armenian
                                0x10A0, 0x10FF,  // Georgian
                                0x1E00, 0x1EFF,  // Latin, with two marks, too
                                0x2010, 0x2027,  // dashes, quotation marks, dots
                                0x20AC, 0x20AC,  // the euro
                                0};

constexpr float kLarge_px = 30;  // of letters that need no places finer than px

}  // namespace

bool addFont(ImFontAtlas& fonts, float size_px) {
  ImFontConfig config;
  if (size_px > kLarge_px) config.OversampleH = 1;
  for (const char* path :
       {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
        "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
        "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
        "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
        "/System/Library/Fonts/Helvetica.ttc"}) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored) &&
        fonts.AddFontFromFileTTF(path, size_px, &config, kLetters))
      return true;
  }
  // A bitmap that looks coarse at this size.
  config = {};
  config.SizePixels = size_px;
  fonts.AddFontDefault(&config);
  return false;
}

}  // namespace skel
