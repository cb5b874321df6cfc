// A skeleton file whose joints are mended.
#pragma once

#include <string>

#include "labeler/drawing_list.h"
#include "labeler/drawing_state.h"
#include "labeler/placed_joints.h"
#include "libskel/silhouette/silhouette.h"
#include "libskel/skeleton/body_plans.h"
#include "libskel/skeleton/skeleton_file.h"

namespace skel {

class SkeletonDocument {
 public:
  // Throws InputError.
  SkeletonDocument(std::string path, const BodyPlans& plans);

  const std::string& path() const { return path_; }
  const std::string& bodyPlan() const { return body_plan_.name; }
  DrawingFiles drawing() const;
  int figureNumber() const { return file_.figure.number; }
  const Skeleton& skeleton() const { return file_.skeleton; }
  const std::string& imageSha256() const {
    return file_.image_sha256;
  }  // that it was found in; "": not known
  const std::string& foundOutline() const { return file_.foundOutline(); }
  const std::optional<SkeletonFile::Mask>& mask() const { return file_.mask; }
  std::string maskPath() const;  // of mask()
  // Throws InputError if the file does not mean this picture.
  void checkSize(const Image& image, const std::string& image_path) const;

  // What is to be in the file.
  struct Content {
    const DrawingState& state;
    const Silhouette& silhouette;
    std::string found_outline;  // SkeletonFile::foundOutline() of the picture of the state
    bool same_mask;             // as when the drawing was opened
    std::string mask_path;      // of the state's mask, if it has one
    const Skeleton* lifted;     // null, or joints that were found anew, with their positions in the model
  };
  // Throws OutputError.
  void write(const Content& content) const;

 private:
  std::string path_;
  SkeletonTemplate body_plan_;
  SkeletonFile file_;
};

}  // namespace skel
