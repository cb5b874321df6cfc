#include "labeler/motion_document.h"

#include "libskel/core/error.h"
#include "libskel/core/files.h"

namespace skel {

MotionDocument::MotionDocument(std::string path, const BodyPlans& plans)
    : path_(std::move(path)),
      body_plan_(planNamed(templateOfMotion(path_), plans)),
      file_(readMotionFile(path_, body_plan_)) {
  for (const MotionFrame& frame : file_.frames)
    if (frame.image_file.empty())
      throw InputError(path_, "has frames without a picture; it was computed, mend what it was made from");
}

std::vector<DrawingFiles> MotionDocument::drawings() const {
  std::vector<DrawingFiles> drawings;
  for (const MotionFrame& frame : file_.frames)
    drawings.push_back(drawingFiles(besideFile(path_, frame.image_file), frame.image_file));
  return drawings;
}

void MotionDocument::checkSize(int frame, const Image& image, const std::string& image_path) const {
  const MotionFrame& claim = file_.frames[static_cast<size_t>(frame)];
  checkMeansPicture(image, image_path, claim.image_width, claim.image_height, path_,
                    "frames[" + std::to_string(frame) + "].image");
}

void MotionDocument::write(int frame, const DrawingJoints& joints) {
  file_.frames[static_cast<size_t>(frame)].joints = joints;
  replaceFile(path_, formatMotionFile(file_, body_plan_));
}

}  // namespace skel
