#include "libskel/window/font.h"

#include <imgui.h>

#include <cstdio>

#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("names with letters from beyond western Europe stood in windows with question marks") {
  ImFontAtlas fonts;
  if (!addFont(fonts, 19)) {
    std::puts("SKIPPED: there is no font with such letters");
    return;
  }
  REQUIRE(fonts.Build());
  for (const char16_t letter : u"Çağla Őszi Ștefan Việt O\u0308mer Ελένη Злата Ђорђе Սona ნინო „…“ – €")
    if (letter != 0) {
      CAPTURE(static_cast<int>(letter));
      CHECK(fonts.Fonts[0]->FindGlyphNoFallback(static_cast<ImWchar>(letter)));
    }
}
