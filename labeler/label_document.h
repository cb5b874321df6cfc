// The label file of a drawing.
#pragma once

#include <optional>
#include <string>

#include "labeler/drawing_list.h"
#include "labeler/figure.h"
#include "labeler/mask_document.h"
#include "libskel/labels/label_file.h"

namespace skel {

class LabelDocument {
 public:
  LabelDocument() = default;
  // Reads the file, if there is one. Throws InputError.
  explicit LabelDocument(DrawingFiles files);

  const std::optional<LabelFile>& opened() const { return opened_; }
  // Of the file that was opened, the labels of this figure's candidates and the joints. Says what is odd
  // about them, or nothing; joints of other body plans are left out. `said`: what has been said before.
  std::string take(const Figure& figure, const BodyPlans& plans, std::string said, DrawingState& state) const;
  // Throws OutputError.
  void write(const DrawingState& state, const Figure& figure, const Image& image,
             const SkeletonTemplate& body_plan, MaskDocument& masks) const;

 private:
  DrawingFiles files_;
  std::optional<LabelFile> opened_;
};

}  // namespace skel
