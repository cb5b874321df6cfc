// Feet that stand stay where they stand.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "libskel/animation/clip.h"

namespace skel {

// A skeleton at one moment: rotations to the model frame, one a joint, and what is added to the root's rest
// position, m.
struct ModelPose {
  float time_s = 0;
  std::vector<Eigen::Quaterniond> globals;
  Eigen::Vector3d root_offset_m = Eigen::Vector3d::Zero();
  double share = 1;  // how much of it is the motion's: 0 at the ends of a clip that starts from the rest pose
};

// Where the joints come to lie, model frame, m.
std::vector<Eigen::Vector3d> jointPositions(const Skeleton& skeleton, const ModelPose& pose);
// One of them: by the rotations of those above it alone.
Eigen::Vector3d jointPosition(const Skeleton& skeleton, const ModelPose& pose, int joint);

struct FootPlanting {
  // One a joint, used for the feet: the height of the foot's joint when it stands, m, and how the foot lies
  // then.
  std::vector<double> standing_y_m;
  std::vector<Eigen::Quaterniond> standing_turn;
  // One a joint, used for the feet: the way in which the knee bends if it is drawn straight.
  std::vector<Eigen::Vector3d> forwards;
  double sinks_m = 0;       // how much lower than it was drawn the root may stand
  double least_lift_m = 0;  // a foot that steps is lifted so far at least, if its leg is long enough
  double as_drawn = 0;      // the share to which a foot in the air is turned as when it stands
  double ramp_s = 0.12;     // a foot comes down to its place and leaves it in so much time
};

// While a foot stands it keeps its place on the ground, or moves with a ground that runs evenly below a
// figure that walks on the spot; what its leg needs for that, its knee gives (two bones and a wish where the
// end should be: the law of cosines), and where the leg is too short the root comes down. `poses`: even
// moments of a motion whose end is its beginning. Contacts name joints with two ancestors.
void plantFeet(const Skeleton& skeleton, const std::vector<FootContact>& contacts,
               const FootPlanting& planting, std::vector<ModelPose>& poses);

}  // namespace skel
