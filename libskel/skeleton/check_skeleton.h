// Skeletons that a program has made itself.
#pragma once

#include <string>

#include "libskel/skeleton/skeleton.h"

namespace skel {

// Throws UsageError that begins with `name` and says which joint is wrong: there is none, a parent that does
// not come before its child, a second root, a place in the model that is not finite or beyond kFarthest.
void checkSkeleton(const Skeleton& skeleton, const std::string& name);

// From the picture's corner, each way: what is farther belongs to no picture.
inline constexpr double kFarthestJoint_px = 1e6;

// Throws UsageError unless `image_px` is finite and no farther than that.
void checkJointPlace(const std::string& joint, const Eigen::Vector2d& image_px, const std::string& name);

}  // namespace skel
