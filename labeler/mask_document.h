// The masks of a drawing on the disk: the one that was opened, and the one that lies beside it.
#pragma once

#include <memory>
#include <string>

#include "labeler/drawing_list.h"
#include "labeler/drawing_state.h"
#include "labeler/skeleton_document.h"
#include "libskel/labels/label_file.h"

namespace skel {

class MaskDocument {
 public:
  MaskDocument() = default;
  // `keep`: a mask file that was there before is not removed.
  MaskDocument(DrawingFiles files, bool keep) : files_(std::move(files)), keep_(keep) {}

  // Each opens a mask and says what is odd about it, or nothing. Throw InputError.
  std::string openOf(const LabelFile& labels, const Image& image);
  std::string openOf(const SkeletonDocument& skeleton, const Image& image);
  void open(const std::string& path, const Image& image);  // that lies beside the drawing

  // What lies there was made for a picture before this one: it, and what is made of it, is given another name
  // (keepAside()) when the drawing has no such mask any more.
  void areOfEarlierPicture() { earlier_ = true; }
  // The drawing has another name than when its mask was made: that is saved under this one, unless one lies
  // there.
  void takeDrawingsName();

  const std::shared_ptr<const MaskVersion>& opened() const { return opened_; }
  std::string path(const MaskVersion& mask) const { return besideFile(files_.image, mask.file); }

  // The label file, with the mask that it speaks of. Throws OutputError.
  void write(const std::shared_ptr<const MaskVersion>& mask, const LabelFile& labels);
  // The mask of another figure than the first, of which no label file speaks. Throws OutputError.
  void writeAlone(const std::shared_ptr<const MaskVersion>& mask);

 private:
  bool isMended(const std::shared_ptr<const MaskVersion>& mask) const;
  void takeAway(const std::shared_ptr<const MaskVersion>& mask);

  DrawingFiles files_;
  bool keep_ = false, earlier_ = false;
  std::shared_ptr<const MaskVersion> opened_, saved_;
};

}  // namespace skel
