#include "libskel/core/unused_keys.h"

#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("keys that nobody uses are named once, on one line") {
  const JsonDocument document =
      JsonDocument::parse(R"({"a": 1, "b": [{"x": 1, "y": 2}, {"y": 3}], "c\n": 0})", "f.json");
  UnusedKeys unused;
  CHECK(unused.note("f.json").empty());
  for (const JsonValue& item : document.root().at("b").items()) unused.take(item, {"x"});
  CHECK(unused.note("f.json") == "f.json: b[].y is not used");
  unused.take(document.root(), {"b"});
  CHECK(unused.note("f.json") == "f.json: a, b[].y, c\\n are not used");
}
