// Pictures that skel writes beside drawings, and that are no drawings.
#pragma once

#include <array>
#include <string_view>

namespace skel {

// What follows the drawing's stem: masks and limbs painted by hand, and what skel-infer writes.
inline constexpr std::array<std::string_view, 5> kResultPictureEndings = {
    ".mask.png", ".limbs.png", ".layers.png", ".silhouette.png", ".overlay.png"};

// By the end of its name, in small letters.
inline bool isResultPicture(std::string_view name) {
  for (const std::string_view ending : kResultPictureEndings)
    if (name.ends_with(ending)) return true;
  return false;
}

}  // namespace skel
