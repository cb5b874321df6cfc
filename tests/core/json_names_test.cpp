#include "libskel/core/json_names.h"

#include <set>

#include "libskel/core/json.h"
#include "libskel/core/rng.h"
#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("names that are UTF-8 stay as they are") {
  for (const char* name : {"", "a.png", "Käfer.png", "猫.png", "🐈.png", "\x7f"}) {
    CHECK(jsonFromFileName(name) == name);
    CHECK(fileNameFromJson(name) == name);
  }
}

TEST_CASE("any bytes become JSON text and come back") {
  const auto comesBack = [](const std::string& name) {
    INFO(name);
    const std::string text = jsonFromFileName(name);
    CHECK(fileNameFromJson(text) == name);
    // The parser refuses what is not UTF-8.
    CHECK(JsonDocument::parse("\"" + text + "\"", "f").root().asFileName() == name);
  };
  for (int byte = 0x80; byte < 0x100; ++byte) comesBack(std::string("a") + static_cast<char>(byte) + ".png");
  // Latin-1, an overlong slash, a surrogate, beyond Unicode, cut off, and the escapes themselves.
  for (const char* name :
       {"h\xe9ros.png", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xf8\x88\x80\x80\x80", "\xe7\x8c",
        "\xee\xbe\x80", "\xee\xbf\xbf\xff", "\xee\xbe"})
    comesBack(name);
  Rng rng(1);
  const std::string bytes = "ab\x80\xbe\xbf\xc3\xa9\xee\xef\xf0\x9f";
  for (int i = 0; i < 2000; ++i) {
    std::string name;
    for (auto length = rng.below(8); length > 0; --length) name += bytes[rng.below(bytes.size())];
    comesBack(name);
  }
}
