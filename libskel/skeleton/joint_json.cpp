#include "libskel/skeleton/joint_json.h"

#include <algorithm>
#include <cmath>

#include "libskel/mesh/triangle_mesh.h"

namespace skel {

JointOrigin originAt(const JsonValue& value) {
  const std::string name = value.asString();
  const auto found = std::find(kJointOriginNames.begin(), kJointOriginNames.end(), name);
  if (found == kJointOriginNames.end())
    value.fail("is \"" + name + "\", must be recognized, completed, derived or edited");
  return static_cast<JointOrigin>(found - kJointOriginNames.begin());
}

Eigen::Vector2d imagePointAt(const JsonValue& value, const std::string& joint, int width, int height) {
  const auto xy = value.asNumbers(2);
  if (xy[0] < -0.5 || xy[1] < -0.5 || xy[0] > width - 0.5 || xy[1] > height - 0.5)
    value.fail("joint \"" + joint + "\" lies outside the image of " + std::to_string(width) + "x" +
               std::to_string(height) + " px");
  return {xy[0], xy[1]};
}

Eigen::Vector3d positionAt(const JsonValue& value) {
  const std::vector<double> numbers = value.asNumbers(3);
  for (const double number : numbers)
    if (std::abs(number) > kFarthest) value.fail("is farther than 1e6 from the origin");
  return {numbers[0], numbers[1], numbers[2]};
}

void checkTemplate(const JsonValue& value, const std::string& template_name) {
  if (const std::string found = value.asString(); found != template_name)
    value.fail("is \"" + found + "\", but the template in use is \"" + template_name +
               "\"; give the same --template");
}

}  // namespace skel
