// Any JSON: every value is asked for everything.
#include <vector>

#include "libskel/core/json.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  mayRefuse([&] {
    const JsonDocument document = JsonDocument::parse(textOf(data, size), "fuzz");
    mayRefuse([&] { document.root().checkFormat("skel-weights", 3); });
    std::vector<JsonValue> open = {document.root()};
    while (!open.empty()) {
      const JsonValue value = open.back();
      open.pop_back();
      mayRefuse([&] { value.asString(); });
      mayRefuse([&] { value.asBool(); });
      mayRefuse([&] { value.asNumber(0, 1); });
      mayRefuse([&] { value.asInt(-3, 1000); });
      mayRefuse([&] { value.asNumbers(2); });
      mayRefuse([&] { value.allowOnly({"name", "parent"}); });
      if (value.isArray())
        for (const JsonValue& item : value.items()) open.push_back(item);
      if (value.isObject())
        for (const std::string& key : value.keys()) open.push_back(value.at(key));
    }
  });
  return 0;
}
