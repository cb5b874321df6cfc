#include "libskel/image/result_picture.h"

#include <string>

#include "libskel/core/file_names.h"

namespace skel {

bool isDrawingName(std::string_view file_name) {
  const std::string name = inSmallLetters(std::string(file_name));
  if (name.starts_with(".") || isResultPicture(name) || name == "mask.png") return false;
  for (const std::string_view ending : kDrawingEndings)
    if (name.ends_with(ending)) return !name.substr(0, name.size() - ending.size()).ends_with(".back");
  return false;
}

}  // namespace skel
