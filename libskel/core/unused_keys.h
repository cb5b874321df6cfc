// Keys of other people's JSON files that skel makes nothing of: ignored, and said.
#pragma once

#include <initializer_list>
#include <set>
#include <string>
#include <string_view>

#include "libskel/core/json.h"

namespace skel {

class UnusedKeys {
 public:
  // Takes those of the object that are none of `used`.
  void take(const JsonValue& object, std::initializer_list<std::string_view> used);
  // "a.json: bones, joints[].children are not used"; empty: all keys are used.
  std::string note(const std::string& file) const;

 private:
  std::set<std::string> keys_;  // paths without indices
};

}  // namespace skel
