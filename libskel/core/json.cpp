#include "libskel/core/json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "libskel/core/check.h"
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

// Builds the document from what the parser meets, looks at the keys, and knows where it stands. (The
// library's own builder with a callback looks at all items of a list again after each that is a list or an
// object.)
class Builder {
 public:
  Builder(const std::string& file, Json& root) : file_(file), root_(root) {}

  bool null() { return put(nullptr); }
  bool boolean(bool value) { return put(value); }
  bool number_integer(Json::number_integer_t value) { return put(value); }
  bool number_unsigned(Json::number_unsigned_t value) { return put(value); }
  bool number_float(Json::number_float_t value, const std::string&) { return put(value); }
  bool string(std::string& value) { return put(std::move(value)); }
  bool binary(Json::binary_t& value) { return put(std::move(value)); }
  bool start_object(std::size_t) { return start(Json::object()); }
  bool start_array(std::size_t) { return start(Json::array()); }
  bool end_object() { return end(); }
  bool end_array() { return end(); }
  bool key(std::string& key) {
    takeKey(std::move(key));
    return true;
  }
  template <class Error>
  bool parse_error(std::size_t, const std::string&, const Error& error) {
    throw error;
  }

  bool isOpen() const { return !open_.empty(); }
  // "joints[3].image[0]"
  std::string path() const {
    std::string text;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      const Open& level = open_[i];
      const std::size_t begun = i + 1 < open_.size();  // an item that is there already
      text += level.json->is_array() ? "[" + std::to_string(level.json->size() - begun) + "]"
                                     : (text.empty() ? "" : ".") + level.key;
    }
    return text;
  }

 private:
  struct Open {
    Json* json;
    std::string key;  // the object's last
    std::set<std::string> keys;
  };

  Json& add(Json value) {
    if (open_.empty()) return root_ = std::move(value);
    Json& parent = *open_.back().json;
    if (parent.is_object()) return parent.emplace(open_.back().key, std::move(value)).first.value();
    parent.push_back(std::move(value));
    return parent.back();
  }
  bool put(Json value) {
    add(std::move(value));
    return true;
  }
  bool start(Json value) {
    if (open_.size() == kMostDepth)
      throw InputError(file_, "is nested deeper than " + std::to_string(kMostDepth) + " levels");
    open_.push_back({&add(std::move(value)), {}, {}});
    return true;
  }
  bool end() {
    open_.pop_back();
    return true;
  }
  void takeKey(std::string key) {
    Open& object = open_.back();
    // The parser keeps the last of several equal keys; a file written by hand deserves to be told.
    if (!object.keys.insert(key).second)
      throw InputError(file_, "has the key \"" + key + "\" twice in one object");
    if (object.keys.size() > kMostKeys)
      throw InputError(file_, "has an object with more than " + std::to_string(kMostKeys) + " keys");
    object.key = std::move(key);
  }

  const std::string& file_;
  Json& root_;
  std::vector<Open> open_;
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
  Builder builder(file, document.content_->json);
  try {
    Json::sax_parse(text, &builder);
  } catch (const nlohmann::json::parse_error& error) {
    const auto upto = text.substr(0, std::min(error.byte, text.size()));
    const auto line = std::count(upto.begin(), upto.end(), '\n') + 1;
    if (text.empty()) throw InputError(file, "is empty, not JSON");
    std::string problem = "is not JSON: line " + std::to_string(line) + " cannot be read";
    if (builder.isOpen() && isNanOrInfinity(text, error.byte))
      problem += ": " + builder.path() + " is not a finite number";
    throw InputError(file, problem);
  } catch (const nlohmann::json::out_of_range&) {
    const std::string path = builder.path();
    throw InputError(file, (path.empty() ? "" : path + ": ") + "is a number that is too large");
  }
  return document;
}

JsonValue JsonDocument::root() const { return JsonValue(&content_->json, &content_->file); }

std::string JsonValue::path() const {
  if (!parent_) return "";
  const std::string before = parent_->path();
  if (!key_) return before + "[" + std::to_string(index_) + "]";
  return before.empty() ? *key_ : before + "." + *key_;
}

void JsonValue::fail(const std::string& problem) const {
  const std::string path = this->path();
  throw InputError(*file_, (path.empty() ? "" : path + ": ") + problem);
}

bool JsonValue::isNull() const { return get(value_).is_null(); }
bool JsonValue::isBool() const { return get(value_).is_boolean(); }
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
  if (!isBool()) fail("must be true or false");
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
  if (size() != count) fail("has " + std::to_string(size()) + " numbers, must have " + std::to_string(count));
  return asNumbers();
}

std::vector<JsonValue> JsonValue::items() const {
  std::vector<JsonValue> values;
  values.reserve(size());
  const auto parent = std::make_shared<const JsonValue>(*this);
  for (const Json& item : get(value_)) {
    JsonValue& value = values.emplace_back(JsonValue(&item, file_));
    value.parent_ = parent;
    value.index_ = values.size() - 1;
  }
  return values;
}

size_t JsonValue::size() const {
  if (!isArray()) fail("must be a list");
  return get(value_).size();
}

JsonValue JsonValue::item(size_t index) const {
  SKEL_CHECK(index < size());
  JsonValue value(&get(value_)[index], file_);
  value.parent_ = std::make_shared<const JsonValue>(*this);
  value.index_ = index;
  return value;
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
  JsonValue value(&*member, file_);
  value.parent_ = std::make_shared<const JsonValue>(*this);
  value.key_ = &member.key();
  return value;
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
