#include "libskel/core/unused_keys.h"

#include <algorithm>
#include <vector>

#include "libskel/core/text.h"

namespace skel {

namespace {

// "joints[]" for "joints[12]".
std::string withoutIndices(const std::string& path) {
  std::string text;
  bool index = false;
  for (const char c : path) {
    if (c == ']') index = false;
    if (!index) text += c;
    if (c == '[') index = true;
  }
  return text;
}

}  // namespace

void UnusedKeys::take(const JsonValue& object, std::initializer_list<std::string_view> used) {
  const std::string path = withoutIndices(object.path());
  for (const std::string& key : object.keys()) {
    if (std::find(used.begin(), used.end(), key) != used.end()) continue;
    keys_.insert(path.empty() ? key : path + "." + key);
  }
}

std::string UnusedKeys::note(const std::string& file) const {
  constexpr std::size_t kNamed = 6;
  if (keys_.empty()) return {};
  std::vector<std::string> names(keys_.begin(), keys_.end());
  const bool more = names.size() > kNamed;
  if (more) names.resize(kNamed);
  return printable(file + ": " + joined(names) + (more ? " and more" : "") +
                   (keys_.size() == 1 ? " is" : " are") + " not used");
}

}  // namespace skel
