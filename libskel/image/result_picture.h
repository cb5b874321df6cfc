// Which files beside drawings are drawings, and which are pictures that were made of one.
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

// Whether a file of this name, without its folder, is taken for a drawing where a folder is read: a picture
// that is no result, no mask and no view of the back (<stem>.back.png), and not hidden. HEIC and AVIF are
// among them, so that whoever reads them says what to do.
bool isDrawingName(std::string_view name);

// The endings of those, in small letters.
inline constexpr std::array<std::string_view, 11> kDrawingEndings = {
    ".png", ".jpg", ".jpeg", ".webp", ".bmp", ".tif", ".tiff", ".gif", ".heic", ".heif", ".avif"};

// The endings of the pictures that can be read, for messages.
inline constexpr std::string_view kPictureEndings = ".png, .jpg, .webp, .bmp, .tif, .gif";

}  // namespace skel
