#include "libskel/core/json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/json_names.h"

namespace skel {
namespace {

using Json = nlohmann::ordered_json;

const Json& get(const void* value) { return *static_cast<const Json*>(value); }

std::string show(double number) {
  const std::string text = Json(number).dump();
  return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
}

// Objects keep the order of their keys and so search them one by one.
constexpr std::size_t kMostKeys = 1000;
// Of lists and objects in one another: what reads, walks or frees them goes as deep as they do.
constexpr std::size_t kMostDepth = 100;

// Follows the parser: looks at the keys, and knows where it stands.
struct Follower {
  struct Open {
    bool is_list;
    std::size_t count = 0;  // of the list's items so far
    std::string key;        // the object's last
    std::set<std::string> keys;
  };
  const std::string& file;
  std::vector<Open> open;

  bool operator()(int /*depth*/, Json::parse_event_t event, Json& parsed) {
    switch (event) {
      case Json::parse_event_t::object_start:
      case Json::parse_event_t::array_start:
        if (open.size() == kMostDepth)
          throw InputError(file, "is nested deeper than " + std::to_string(kMostDepth) + " levels");
        open.push_back({event == Json::parse_event_t::array_start, 0, {}, {}});
        break;
      case Json::parse_event_t::object_end:
      case Json::parse_event_t::array_end:
        open.pop_back();
        [[fallthrough]];
      case Json::parse_event_t::value:
        if (!open.empty()) ++open.back().count;
        break;
      case Json::parse_event_t::key:
        takeKey(parsed.get<std::string>());
    }
    return true;
  }

  void takeKey(std::string key) {
    Open& object = open.back();
    // The parser keeps the last of several equal keys; a file written by hand deserves to be told.
    if (!object.keys.insert(key).second)
      throw InputError(file, "has the key \"" + key + "\" twice in one object");
    if (object.keys.size() > kMostKeys)
      throw InputError(file, "has an object with more than " + std::to_string(kMostKeys) + " keys");
    object.key = std::move(key);
  }

  // "joints[3].image[0]"
  std::string path() const {
    std::string text;
    for (const Open& level : open)
      text += level.is_list ? "[" + std::to_string(level.count) + "]" : (text.empty() ? "" : ".") + level.key;
    return text;
  }
};

// Other programs write numbers into JSON that it does not have.
bool isNanOrInfinity(std::string_view text, std::size_t at) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  std::size_t begin = std::min(at, text.size()), end = begin;
  while (begin > 0 && is_letter(text[begin - 1])) --begin;
  while (end < text.size() && is_letter(text[end])) ++end;
  std::string word(text.substr(begin, end - begin));
  std::transform(word.begin(), word.end(), word.begin(), [](char c) { return c | 0x20; });
  return word == "nan" || word == "inf" || word == "infinity";
}

}  // namespace

struct JsonDocument::Content {
  Json json;
  std::string file;
};

JsonDocument::JsonDocument() : content_(std::make_unique<Content>()) {}
JsonDocument::JsonDocument(JsonDocument&&) noexcept = default;
JsonDocument::~JsonDocument() = default;

JsonDocument JsonDocument::readFile(const std::string& path) { return parse(skel::readFile(path), path); }

JsonDocument JsonDocument::parse(std::string_view text, const std::string& file) {
  JsonDocument document;
  document.content_->file = file;
  Follower follower{file, {}};
  try {
    document.content_->json = Json::parse(text, std::ref(follower));
  } catch (const nlohmann::json::parse_error& error) {
    const auto upto = text.substr(0, std::min(error.byte, text.size()));
    const auto line = std::count(upto.begin(), upto.end(), '\n') + 1;
    if (text.empty()) throw InputError(file, "is empty, not JSON");
    std::string problem = "is not JSON: line " + std::to_string(line) + " cannot be read";
    if (!follower.open.empty() && isNanOrInfinity(text, error.byte))
      problem += ": " + follower.path() + " is not a finite number";
    throw InputError(file, problem);
  } catch (const nlohmann::json::out_of_range&) {
    const std::string path = follower.path();
    throw InputError(file, (path.empty() ? "" : path + ": ") + "is a number that is too large");
  }
  return document;
}

JsonValue JsonDocument::root() const { return JsonValue(&content_->json, "", &content_->file); }

void JsonValue::fail(const std::string& problem) const {
  throw InputError(*file_, (path_.empty() ? "" : path_ + ": ") + problem);
}

bool JsonValue::isNull() const { return get(value_).is_null(); }
bool JsonValue::isNumber() const { return get(value_).is_number(); }
bool JsonValue::isString() const { return get(value_).is_string(); }
bool JsonValue::isArray() const { return get(value_).is_array(); }
bool JsonValue::isObject() const { return get(value_).is_object(); }

std::string JsonValue::asString() const {
  if (!isString()) fail("must be a text");
  return get(value_).get<std::string>();
}

std::string JsonValue::asFileName() const { return fileNameFromJson(asString()); }

bool JsonValue::asBool() const {
  if (!get(value_).is_boolean()) fail("must be true or false");
  return get(value_).get<bool>();
}

double JsonValue::asNumber() const {
  if (!isNumber()) fail("must be a number");
  const double number = get(value_).get<double>();
  if (!std::isfinite(number)) fail("must be a finite number");
  return number;
}

double JsonValue::asNumber(double low, double high) const {
  const double number = asNumber();
  if (number < low || number > high)
    fail("is " + show(number) + ", must be between " + show(low) + " and " + show(high));
  return number;
}

int JsonValue::asInt(int low, int high) const {
  const double number = asNumber();
  if (number != std::floor(number) || number < low || number > high)
    fail("is " + show(number) + ", must be a whole number between " + std::to_string(low) + " and " +
         std::to_string(high));
  return static_cast<int>(number);
}

std::vector<double> JsonValue::asNumbers() const {
  std::vector<double> numbers;
  for (const JsonValue& item : items()) numbers.push_back(item.asNumber());
  return numbers;
}

std::vector<double> JsonValue::asNumbers(size_t count) const {
  std::vector<double> numbers = asNumbers();
  if (numbers.size() != count)
    fail("has " + std::to_string(numbers.size()) + " numbers, must have " + std::to_string(count));
  return numbers;
}

std::vector<JsonValue> JsonValue::items() const {
  if (!isArray()) fail("must be a list");
  std::vector<JsonValue> values;
  for (const Json& item : get(value_))
    values.push_back(JsonValue(&item, path_ + "[" + std::to_string(values.size()) + "]", file_));
  return values;
}

std::vector<std::string> JsonValue::keys() const {
  if (!isObject()) fail("must be an object");
  std::vector<std::string> names;
  for (const auto& member : get(value_).items()) names.push_back(member.key());
  return names;
}

JsonValue JsonValue::at(std::string_view key) const {
  const auto member = find(key);
  if (!member) fail("lacks \"" + std::string(key) + "\"");
  return *member;
}

std::optional<JsonValue> JsonValue::find(std::string_view key) const {
  if (!isObject()) fail("must be an object");
  const auto member = get(value_).find(std::string(key));
  if (member == get(value_).end()) return std::nullopt;
  return JsonValue(&*member, path_.empty() ? std::string(key) : path_ + "." + std::string(key), file_);
}

void JsonValue::allowOnly(std::initializer_list<std::string_view> allowed) const {
  for (const std::string& key : keys())
    if (std::find(allowed.begin(), allowed.end(), key) == allowed.end())
      fail("has the unknown key \"" + key + "\"");
}

int JsonValue::checkFormat(std::string_view format, int newest_version) const {
  const std::string found = at("format").asString();
  if (found != format)
    fail("is a file of format \"" + found + "\", \"" + std::string(format) + "\" was expected");
  const JsonValue version = at("version");
  const double number = version.asNumber();
  if (number > newest_version)
    version.fail("is " + show(number) + ", this program reads up to " + std::to_string(newest_version) +
                 "; use a newer skel");
  return version.asInt(1, newest_version);
}

}  // namespace skel
