#include "labeler/drawing_state.h"

#include <filesystem>

#include "libskel/core/files.h"
#include "libskel/core/sha256.h"
#include "libskel/image/write_image.h"
#include "libskel/labels/annotated_image.h"

namespace skel {

std::shared_ptr<const MaskVersion> readMaskVersion(const std::string& path, const Image& image) {
  auto mask = std::make_shared<MaskVersion>();
  mask->pixels = readMaskOf(image, path);
  mask->file = std::filesystem::path(path).filename().string();
  mask->png = readFile(path);
  mask->sha256 = sha256(mask->png);
  return mask;
}

bool sameFile(const MaskVersion* a, const MaskVersion* b) {
  return a == b || (a && b && a->file == b->file && a->sha256 == b->sha256);
}

std::shared_ptr<const MaskVersion> sealed(const MaskVersion& stroke) {
  auto mask = std::make_shared<MaskVersion>(stroke);
  mask->png = encodePng(mask->pixels);
  mask->sha256 = sha256(mask->png);
  return mask;
}

bool DrawingState::operator==(const DrawingState& other) const {
  const bool same_mask = mask == other.mask || (mask && other.mask && mask->file == other.mask->file &&
                                                (mask->pixels == other.mask->pixels).all());
  const auto samePixels = [](const Plane8& a, const Plane8& b) {
    return a.size() == b.size() && (a.size() == 0 || (a == b).all());
  };
  const bool same_layers =
      layers == other.layers || (layers && other.layers && samePixels(layers->limb, other.layers->limb) &&
                                 samePixels(layers->part, other.layers->part));
  return image_sha256 == other.image_sha256 && body_plan == other.body_plan && same_mask && same_layers &&
         labels == other.labels && joints == other.joints;
}

}  // namespace skel
