// The label file of a drawing.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "labeler/drawing_list.h"
#include "labeler/figure.h"
#include "labeler/mask_document.h"
#include "libskel/labels/label_file.h"
#include "libskel/mended/former_names.h"

namespace skel {

class LabelDocument {
 public:
  LabelDocument() = default;
  // Reads the file. Where there is none, or a blank one, that which was made for the picture of that hash,
  // which is asked for then alone, when it had another name, if there is one. Throws InputError.
  LabelDocument(DrawingFiles files, const std::function<std::string()>& image_sha256, FormerNames& names);

  const std::optional<LabelFile>& opened() const { return opened_; }
  // The file that was opened.
  const std::string& path() const { return path_; }
  bool isOfFormerName() const { return path_ != files_.labels; }
  // Of the file that was opened, the labels of this figure's candidates and the joints. Says what is odd
  // about them, or nothing; joints of other body plans are left out. `said`: what has been said before.
  std::string take(const Figure& figure, const BodyPlans& plans, std::string said, DrawingState& state) const;
  // Throws OutputError.
  void write(const DrawingState& state, const Figure& figure, const Image& image,
             const SkeletonTemplate& body_plan, MaskDocument& masks) const;

 private:
  DrawingFiles files_;
  std::string path_;
  std::optional<LabelFile> opened_;
};

}  // namespace skel
