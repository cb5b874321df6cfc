#include "libskel/export/rest_pose.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "libskel/animation/bone_turn.h"
#include "libskel/core/error.h"
#include "libskel/deform/skin_vertices.h"

namespace skel {

namespace {

// From straight down outwards.
constexpr double kLegDegrees = 4;
double armDegrees(RestPose pose) { return pose == RestPose::kT ? 90 : 45; }

}  // namespace

RiggedCharacter poseToRest(const RiggedCharacter& character, RestPose pose) {
  if (pose == RestPose::kDrawn) return character;
  const Skeleton& skeleton = character.skeleton;
  std::vector<Eigen::Vector3d> wanted(skeleton.joints.size(), Eigen::Vector3d::Zero());
  const auto point = [&](const std::string& joint, double degrees) {
    const int index = skeleton.find(joint);
    if (index < 0)
      throw UsageError("only a biped has the rest poses A and T; the skeleton lacks \"" + joint + "\"");
    const double angle = degrees * std::numbers::pi / 180, side = joint.starts_with("left_") ? 1 : -1;
    wanted[index] = {side * std::sin(angle), -std::cos(angle), 0};
  };
  for (const std::string side : {"left_", "right_"}) {
    for (const char* joint : {"shoulder", "elbow", "hand"}) point(side + joint, armDegrees(pose));
    for (const char* joint : {"hip", "knee", "foot"}) point(side + joint, kLegDegrees);
  }

  const std::vector<BoneTurn> drawn_from_wanted = turnsFromCanonical(skeleton, wanted);
  std::vector<Eigen::Quaterniond> globals;
  std::vector<Eigen::Quaternionf> locals;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const int parent = skeleton.joints[j].parent;
    const Eigen::Quaterniond above = parent < 0 ? Eigen::Quaterniond::Identity() : globals[parent];
    globals.push_back(wanted[j].isZero() ? above : drawn_from_wanted[j].share(1).conjugate());
    locals.push_back((above.conjugate() * globals[j]).normalized().cast<float>());
  }

  RiggedCharacter posed = character;
  const JointTransforms transforms = posedFromRest(skeleton, locals);
  posed.mesh.vertices = skinVertices(character.mesh.vertices, character.weights, transforms);
  const Eigen::RowVector3f before = character.mesh.vertices.colwise().minCoeff();
  const Eigen::RowVector3f after = posed.mesh.vertices.colwise().minCoeff();
  const float lift = before.y() - after.y();
  posed.mesh.vertices.col(1).array() += lift;
  const std::vector<Eigen::Vector3f> joints = posedJoints(skeleton, transforms);
  for (std::size_t j = 0; j < joints.size(); ++j)
    posed.skeleton.joints[j].position = joints[j].cast<double>() + Eigen::Vector3d(0, lift, 0);
  return posed;
}

}  // namespace skel
