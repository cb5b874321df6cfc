// A motion file whose joints are mended, frame by frame.
#pragma once

#include <string>
#include <vector>

#include "labeler/drawing_list.h"
#include "labeler/placed_joints.h"
#include "libskel/skeleton/body_plans.h"

namespace skel {

class MotionDocument {
 public:
  // Throws InputError, also where frames have no picture.
  MotionDocument(std::string path, const BodyPlans& plans);

  const std::string& bodyPlan() const { return body_plan_.name; }
  std::vector<DrawingFiles> drawings() const;  // one a frame
  const DrawingJoints& joints(int frame) const { return file_.frames[static_cast<size_t>(frame)].joints; }
  // Throws InputError if the frame does not mean this picture.
  void checkSize(int frame, const Image& image, const std::string& image_path) const;
  // Throws OutputError; the joints are kept.
  void write(int frame, const DrawingJoints& joints);

 private:
  std::string path_;
  SkeletonTemplate body_plan_;
  MotionFile file_;
};

}  // namespace skel
