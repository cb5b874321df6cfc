#include "libskel/core/json.h"

#include "libskel/core/error.h"
#include "tests/support/catch.h"

using namespace skel;

namespace {

// What is wrong with the value at "a" when it is read by `read`.
template <class Read>
std::string complaint(const std::string& text, Read read) {
  const JsonDocument document = JsonDocument::parse(text, "f.json");
  try {
    read(document.root());
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("values come back") {
  const JsonDocument document =
      JsonDocument::parse(R"({"n": 2.5, "s": "x", "l": [1, 2], "b": true, "z": null})", "f");
  const JsonValue root = document.root();
  CHECK(root.at("n").asNumber() == 2.5);
  CHECK(root.at("s").asString() == "x");
  CHECK(root.at("l").asNumbers() == std::vector<double>{1, 2});
  CHECK(root.at("b").asBool());
  CHECK(root.at("z").isNull());
  CHECK_FALSE(root.find("y"));
  CHECK(root.keys() == std::vector<std::string>{"n", "s", "l", "b", "z"});
}

TEST_CASE("a complaint names file, path and reason") {
  CHECK(complaint(R"({"joints": [{"image": [1, "x"]}]})", [](const JsonValue& root) {
          root.at("joints").items()[0].at("image").asNumbers(2);
        }) == "f.json: joints[0].image[1]: must be a number");
  CHECK(complaint(R"({"a": 7})", [](const JsonValue& root) { root.at("a").asNumber(0, 1); }) ==
        "f.json: a: is 7, must be between 0 and 1");
  CHECK(complaint(R"({"a": 1.5})", [](const JsonValue& root) { root.at("a").asInt(0, 9); }) ==
        "f.json: a: is 1.5, must be a whole number between 0 and 9");
  CHECK(complaint(R"({"a": 1})", [](const JsonValue& root) { root.at("b"); }) == "f.json: lacks \"b\"");
  CHECK(complaint(R"({"a": {"c": 1}})", [](const JsonValue& root) { root.at("a").allowOnly({"b"}); }) ==
        "f.json: a: has the unknown key \"c\"");
}

TEST_CASE("what is not JSON is refused with its line") {
  CHECK_THROWS_WITH(JsonDocument::parse("{\n\"a\": 1,\n}", "f.json"),
                    "f.json: is not JSON: line 3 cannot be read");
  CHECK_THROWS_WITH(JsonDocument::parse("", "f.json"), "f.json: is empty, not JSON");
  CHECK_THROWS_WITH(JsonDocument::parse(R"({"a": {"b": 1, "b": 2}})", "f.json"),
                    "f.json: has the key \"b\" twice in one object");
  for (const char* number : {"NaN", "nan", "-nan", "Infinity", "-Infinity", "inf", "-inf"})
    CHECK_THROWS_WITH(JsonDocument::parse(
                          std::string(R"({"a": [{"b": []}, {"b": [1, [], {}, )") + number + "]}]}", "f.json"),
                      "f.json: is not JSON: line 1 cannot be read: a[1].b[3] is not a finite number");
  CHECK_THROWS_WITH(JsonDocument::parse("NaN", "f.json"), "f.json: is not JSON: line 1 cannot be read");
  CHECK_THROWS_WITH(JsonDocument::parse("1e999", "f.json"), "f.json: is a number that is too large");
  CHECK_THROWS_WITH(JsonDocument::parse("{\"a\": {\"b\": 1, \"c\": 1e999}}", "f.json"),
                    "f.json: a.c: is a number that is too large");
}

TEST_CASE("objects of endless length are refused before they cost time") {
  const auto keys = [](int count) {
    std::string text = "{";
    for (int i = 0; i < count; ++i) text += (i ? ",\"k" : "\"k") + std::to_string(i) + "\":0";
    return text + "}";
  };
  CHECK(JsonDocument::parse(keys(1000), "f.json").root().keys().size() == 1000);
  CHECK_THROWS_WITH(JsonDocument::parse(keys(1'000'000), "f.json"),
                    "f.json: has an object with more than 1000 keys");
}

TEST_CASE("a list of very many objects takes no longer than its length says") {
  // By pairs it would be 10^11 steps.
  constexpr int kCount = 400'000;
  std::string text = "[{}";
  for (int i = 1; i < kCount; ++i) text += ",{}";
  CHECK(JsonDocument::parse(text + "]", "f.json").root().items().size() == kCount);
}

TEST_CASE("lists in lists without end are refused before they cost memory") {
  const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  CHECK_NOTHROW(JsonDocument::parse(nested(100), "f.json"));
  CHECK_THROWS_WITH(JsonDocument::parse(nested(101), "f.json"), "f.json: is nested deeper than 100 levels");
  CHECK_THROWS_WITH(JsonDocument::parse(std::string(20'000'000, '['), "f.json"),
                    "f.json: is nested deeper than 100 levels");
  std::string objects;
  for (int i = 0; i < 101; ++i) objects += "{\"a\":";
  CHECK_THROWS_WITH(JsonDocument::parse(objects, "f.json"), "f.json: is nested deeper than 100 levels");
}

TEST_CASE("format and version are checked") {
  const auto check = [](const JsonValue& root) { root.checkFormat("skel-x", 2); };
  CHECK(complaint(R"({"format": "skel-x", "version": 2})", check) == "none");
  CHECK(complaint(R"({"format": "skel-y", "version": 2})", check) ==
        "f.json: is a file of format \"skel-y\", \"skel-x\" was expected");
  CHECK(complaint(R"({"format": "skel-x", "version": 3})", check) ==
        "f.json: version: is 3, this program reads up to 2; use a newer skel");
}
