// The rig: a tree of named joints, in the drawing and in the model.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skel {

// How a joint came to be where it is.
enum class JointOrigin {
  kRecognized,  // found in the drawing
  kCompleted,   // not found; placed from the template's preset
  kDerived,     // computed from other joints (pelvis, neck, head_top)
  kEdited,      // placed by a person
};
// As skeleton files spell them.
inline constexpr std::array<std::string_view, 4> kJointOriginNames = {"recognized", "completed", "derived",
                                                                      "edited"};
std::string_view jointOriginName(JointOrigin origin);

struct Joint {
  std::string name;
  int parent = -1;                                     // index of an earlier joint, -1 for the root
  Eigen::Vector2d image = Eigen::Vector2d::Zero();     // image px
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // model frame, m: y up, +z to the viewer
  double confidence = 0;                               // [0, 1]
  JointOrigin origin = JointOrigin::kCompleted;
  // Where the bone that the joint moves ends, model frame, m, if a file says so: where one joint of a
  // skeleton has a tail, those without move no bone of their own.
  std::optional<Eigen::Vector3d> tail = std::nullopt;
};

// Left and right are the character's own: one that faces us has its right hand at the left of the image.
struct Skeleton {
  std::string template_name;
  std::vector<Joint> joints;  // parents before children; exactly one root, joint 0

  // -1 if there is none of that name.
  int find(std::string_view name) const;
  // Aborts if there is none of that name.
  int index(std::string_view name) const;
};

}  // namespace skel
