#include "labeler/mask_document.h"

#include <filesystem>

#include "labeler/save_drawing.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"

namespace skel {

namespace fs = std::filesystem;

std::string MaskDocument::openOf(const LabelFile& labels, const Image& image) {
  open(besideLabelFile(files_.labels, labels.mask->file), image);
  if (saved_->sha256 == labels.mask->sha256) return {};
  return labels.mask->file + " has changed since it was labelled: look through the labels";
}

std::string MaskDocument::openOf(const SkeletonDocument& skeleton, const Image& image) {
  const std::string path = skeleton.maskPath();
  auto mask = std::make_shared<MaskVersion>(*readMaskVersion(path, image));
  std::string said;
  if (mask->sha256 != skeleton.mask()->sha256)
    said = path + " has changed since the skeleton was found: look through the joints";
  std::error_code not_there;
  // Label files speak of masks in their own folder only: with labels a mask from elsewhere is saved there.
  const bool beside = fs::equivalent(path, this->path(*mask), not_there);
  if (!beside && skeleton.figureNumber() == 1) mask->file = fs::path(files_.mask).filename().string();
  if (!beside && fs::exists(files_.mask) && readFile(files_.mask) != mask->png)
    throw InputError(files_.mask, "is not the mask that " + skeleton.path() + " was made with, " + path +
                                      "; take one of them away");
  opened_ = mask;
  if (beside || fs::exists(files_.mask)) saved_ = mask;
  return said;
}

void MaskDocument::open(const std::string& path, const Image& image) {
  opened_ = saved_ = readMaskVersion(path, image);
}

void MaskDocument::takeDrawingsName() {
  if (!opened_ || fs::exists(files_.mask)) return;
  auto mask = std::make_shared<MaskVersion>(*opened_);
  mask->file = fs::path(files_.mask).filename().string();
  opened_ = mask;
  saved_ = nullptr;
}

void MaskDocument::write(const std::shared_ptr<const MaskVersion>& mask, const LabelFile& labels) {
  // One that does not fit this picture was not opened.
  if (earlier_ && !opened_) keepAside(files_.mask);
  if (!opened_) earlier_ = false;
  if (isMended(mask)) {
    saveWithMask(files_.labels, labels, mask->png);
    saved_ = mask;
    return;
  }
  writeLabelFile(files_.labels, labels);
  takeAway(mask);
}

void MaskDocument::writeAlone(const std::shared_ptr<const MaskVersion>& mask) {
  if (!isMended(mask)) return takeAway(mask);
  replaceFile(files_.mask, mask->png);
  saved_ = mask;
}

bool MaskDocument::isMended(const std::shared_ptr<const MaskVersion>& mask) const {
  return mask && mask != saved_ && mask->file == fs::path(files_.mask).filename().string();
}

// One that was undone altogether; one that had been there before stays.
void MaskDocument::takeAway(const std::shared_ptr<const MaskVersion>& mask) {
  if (mask || !saved_ || besideLabelFile(files_.labels, saved_->file) != files_.mask) return;
  if (keep_ && !earlier_) return;
  earlier_ ? keepAside(files_.mask) : removeFile(files_.mask);
  saved_ = nullptr;
}

}  // namespace skel
