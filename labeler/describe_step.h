// What a step has changed, to be said when it is undone, perhaps on another drawing and in another view.
#pragma once

#include <string>
#include <vector>

#include "labeler/drawing_state.h"
#include "libskel/skeleton/template.h"

namespace skel {

enum class Work { kMask, kLimbs, kJoints, kClasses };

// Not classes that follow a mask.
std::vector<Work> worksOf(const DrawingState& before, const DrawingState& after);

// "a stroke of the mask", "the left hand", "the classes of 3 candidates". `body_plan`: of `after`.
std::string describeStep(const DrawingState& before, const DrawingState& after,
                         const SkeletonTemplate& body_plan);

}  // namespace skel
