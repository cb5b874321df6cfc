#include "libskel/core/natural_order.h"

#include <vector>

#include "tests/support/catch.h"

using namespace skel;

namespace {

void checkOrder(const std::vector<std::string>& sorted) {
  for (size_t i = 0; i < sorted.size(); ++i)
    for (size_t k = 0; k < sorted.size(); ++k) {
      CAPTURE(sorted[i], sorted[k]);
      CHECK(comesBefore(sorted[i], sorted[k]) == (i < k));
    }
}

}  // namespace

TEST_CASE("numbers in the names of frames count as numbers") {
  checkOrder({"", "a", "a1", "a2", "a10", "a10b", "a10b1", "a11", "ab", "b"});
  CHECK(comesBefore("a01", "a1") != comesBefore("a1", "a01"));
  CHECK(comesBefore("a01", "a2"));
  CHECK(comesBefore("a99999999999999999999", "a100000000000000000000"));
}

TEST_CASE("names in small letters stood behind all others") {
  checkOrder({"Anna", "neu 3", "Neu 10", "scan0007", "Zoë"});
  checkOrder({"_", "a", "z"});
  CHECK(comesBefore("anna", "Anna") != comesBefore("Anna", "anna"));
}

TEST_CASE("names that begin with a letter with a mark stood before all others") {
  checkOrder({"Anna", "Åsa", "Ayşe 2", "Ayşe 10", "Çağla", "Carl", "Cem", "Emma", "Łukasz", "Olga", "Ömer",
              "Otto", "Zoë", "Zofia", "Žofie 2", "Σοφία", "Анна"});
  // As a Mac writes names into archives: a letter and its mark.
  checkOrder({"Olga", "O\u0308mer", "Ömer 2", "O\u0308mer 3", "Otto"});
  CHECK(comesBefore("Ann", "Änn") != comesBefore("Änn", "Ann"));
  // Bytes that are no UTF-8, and letters cut in two.
  checkOrder({"a", "z", "z\xC3", "z\xC3z", "z\xF6"});
}

TEST_CASE("names without the marks of their letters") {
  CHECK(withoutMarks("\xc3\x96mer") == "Omer");
  CHECK(withoutMarks("Zoe\xcc\x88") == "Zoe");
  CHECK(withoutMarks("\xe7\x8e\x8b 1") == "\xe7\x8e\x8b 1");
}
