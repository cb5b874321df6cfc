#include "libskel/image/result_picture.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace skel {

bool isDrawingName(std::string_view file_name) {
  std::string name(file_name);
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  if (name.starts_with(".") || isResultPicture(name) || name == "mask.png") return false;
  for (const std::string_view ending : kDrawingEndings)
    if (name.ends_with(ending)) return !name.substr(0, name.size() - ending.size()).ends_with(".back");
  return false;
}

}  // namespace skel
