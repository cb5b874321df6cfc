#include "libskel/core/nearest_word.h"

#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("a mistyped name is told from one that is not there at all") {
  const std::vector<std::string> clips = {"idle", "walk", "run", "jump", "wave", "dance"};
  CHECK(nearestWord("dnce", clips) == "dance");
  CHECK(nearestWord("wawe", clips) == "wave");
  CHECK(nearestWord("walks", clips) == "walk");
  CHECK(nearestWord("moonwalk", clips) == "");
  CHECK(nearestWord("", clips) == "");
  CHECK(nearestWord("dance", {}) == "");
}
