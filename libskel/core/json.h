// Reading JSON so that every complaint names the file, the place in it and the reason, and nothing unknown
// passes.
//
//   const JsonDocument document = JsonDocument::readFile("biped.json");
//   const JsonValue root = document.root();
//   root.allowOnly({"format", "version", "joints"});
//   for (const JsonValue& joint : root.at("joints").items()) names.push_back(joint.at("name").asString());
#pragma once

#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skel {

class JsonDocument;

// A look at one value of a JsonDocument, which must outlive it. All as…() and at() throw InputError that
// names the file and the path of the value, such as `joints[3].image`.
class JsonValue {
 public:
  bool isNull() const;
  bool isBool() const;
  bool isNumber() const;
  bool isString() const;
  bool isArray() const;
  bool isObject() const;

  std::string asString() const;
  std::string asFileName() const;  // see json_names.h
  bool asBool() const;
  double asNumber() const;                            // finite
  double asNumber(double low, double high) const;     // in [low, high]
  int asInt(int low, int high) const;                 // a whole number in [low, high]
  std::vector<double> asNumbers() const;              // an array of finite numbers
  std::vector<double> asNumbers(size_t count) const;  // exactly `count` of them

  // Elements of an array.
  std::vector<JsonValue> items() const;
  size_t size() const;
  JsonValue item(size_t index) const;  // that there is
  // Keys of an object, in the file's order.
  std::vector<std::string> keys() const;
  // A required member of an object.
  JsonValue at(std::string_view key) const;
  // A member that may be missing.
  std::optional<JsonValue> find(std::string_view key) const;

  // Refuses an object with any other key.
  void allowOnly(std::initializer_list<std::string_view> keys) const;
  // Checks "format" and "version" of a file's root: refuses another format and any version outside [1,
  // newest]. Returns the version.
  int checkFormat(std::string_view format, int newest_version) const;

  // Throws InputError with this value's file and path.
  [[noreturn]] void fail(const std::string& problem) const;
  std::string path() const;

 private:
  friend class JsonDocument;
  JsonValue(const void* value, const std::string* file) : value_(value), file_(file) {}
  const void* value_;
  const std::string* file_;
  // What holds it, and where in that: none of it is text before somebody asks for the path.
  std::shared_ptr<const JsonValue> parent_;
  const std::string* key_ = nullptr;  // null: of an array, at index_
  size_t index_ = 0;
};

class JsonDocument {
 public:
  // Throws InputError: cannot be read, not JSON (with line and column), too deep, a key twice in one object.
  static JsonDocument readFile(const std::string& path);
  // `file` is the name that complaints use.
  static JsonDocument parse(std::string_view text, const std::string& file);
  JsonDocument(JsonDocument&&) noexcept;
  ~JsonDocument();

  JsonValue root() const;

 private:
  JsonDocument();
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace skel
