// The joints of a drawing whose skeleton file somebody has mended, for who goes on in the drawing itself.
#pragma once

#include <optional>
#include <string>

#include "labeler/drawing_list.h"
#include "labeler/label_document.h"
#include "labeler/placed_joints.h"
#include "libskel/skeleton/body_plans.h"

namespace skel {

// Whether a person has moved joints in <stem>.skeleton.json beside the drawing.
bool isMendedBeside(const DrawingFiles& files);

struct MendedJoints {
  const SkeletonTemplate* body_plan;  // one of `plans`
  DrawingJoints joints;
};

// Where isMendedBeside(), of the first figure and found in this very picture: the joints of that skeleton and
// of the label file, which of them are placed, and where, by the rule of skel-infer
// (libskel/mended/mended_files.h). Nothing where none is left that a person has placed.
std::optional<MendedJoints> mendedJointsBeside(const DrawingFiles& files, const LabelDocument& labels,
                                               const std::string& image_sha256, const BodyPlans& plans);

}  // namespace skel
