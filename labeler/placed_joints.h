// The joints of a drawing that is being labelled: one a joint of the template, or nothing where none is
// known.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "labeler/drawing_list.h"
#include "libskel/labels/label_file.h"
#include "libskel/skeleton/body_plans.h"
#include "libskel/skeleton/motion_file.h"

namespace skel {

using DrawingJoints = std::vector<std::optional<PlacedJoint>>;

// Whose joints a label file has; null: those of another body plan, which do not count.
const SkeletonTemplate* planOf(const LabelFile& labels, const BodyPlans& plans);

// As label files name them; none if none is known.
NamedJoints namedJoints(const DrawingJoints& joints, const SkeletonTemplate& body_plan);
// Those that a label file knows.
void takeJoints(const LabelFile& labels, const SkeletonTemplate& body_plan, DrawingJoints& joints);
// Those of a skeleton in the drawing.
void takeJoints(const Skeleton& skeleton, const SkeletonTemplate& body_plan, DrawingJoints& joints);
// Puts the skeleton's joints where those are that are known.
void placeJoints(const DrawingJoints& joints, const SkeletonTemplate& body_plan, Skeleton& skeleton);
// Joints half way between two others follow them, unless a person has placed them.
void deriveMidpoints(DrawingJoints& joints, const SkeletonTemplate& body_plan);

// Joints that nobody has to look for any more.
int countFound(const DrawingJoints& joints);
// Joints that do not follow from others, and those of them that were placed by hand.
Progress progressOf(const DrawingJoints& joints, const SkeletonTemplate& body_plan);
// The same of what a label file says.
Progress jointsOf(const LabelFile& labels, const BodyPlans& plans);

// The nearest within `radius_px`; -1 if there is none.
int jointAt(const DrawingJoints& joints, const Eigen::Vector2d& image_px, double radius_px);

}  // namespace skel
