// What files say about a joint in the same way.
#pragma once

#include <cmath>

#include "libskel/core/json.h"
#include "libskel/skeleton/skeleton.h"

namespace skel {

// To 1 / `steps`.
inline double rounded(double value, double steps) {
  const double r = std::round(value * steps) / steps;
  return r == 0 ? 0 : r;  // no -0
}

// All throw InputError with file and JSON path.
JointOrigin originAt(const JsonValue& value);
// [x, y] within the pixels of an image.
Eigen::Vector2d imagePointAt(const JsonValue& value, const std::string& joint, int width, int height);
// [x, y, z], no farther than kFarthest.
Eigen::Vector3d positionAt(const JsonValue& value);
// Refuses a file of another template.
void checkTemplate(const JsonValue& value, const std::string& template_name);

}  // namespace skel
