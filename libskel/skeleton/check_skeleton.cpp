#include "libskel/skeleton/check_skeleton.h"

#include "libskel/core/error.h"
#include "libskel/core/json_names.h"
#include "libskel/mesh/triangle_mesh.h"

namespace skel {

void checkSkeleton(const Skeleton& skeleton, const std::string& name) {
  constexpr double kRounding = 1e-6;
  if (skeleton.joints.empty()) throw UsageError(name + " has no joints");
  const auto lies = [](const Eigen::Vector3d& place) {
    return place.cwiseAbs().maxCoeff() <= kFarthest * (1 + kRounding) && place.allFinite();
  };
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    const auto refuse = [&](const std::string& why) {
      throw UsageError(name + ".joints[" + std::to_string(j) + "], \"" + jsonFromFileName(joint.name) +
                       "\", " + why);
    };
    if (jsonFromFileName(joint.name) != joint.name) refuse("has a name that is no UTF-8");
    if (j == 0 ? joint.parent != -1 : joint.parent < 0 || std::size_t(joint.parent) >= j)
      refuse(j == 0 ? "is the root, and must have the parent -1"
                    : "must have a joint before it as its parent");
    if (!lies(joint.position) || (joint.tail && !lies(*joint.tail)))
      refuse("must lie in the model at finite numbers of at most 1e6");
  }
}

void checkJointPlace(const std::string& joint, const Eigen::Vector2d& image_px, const std::string& name) {
  if (!image_px.allFinite() || image_px.cwiseAbs().maxCoeff() > kFarthestJoint_px)
    throw UsageError(name + ": the place of \"" + joint + "\" must be finite numbers of at most 1e6 px");
}

}  // namespace skel
