// Our clips on skeletons whose joints have names of their own.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "libskel/animation/clip.h"
#include "libskel/animation/figure_shape.h"

namespace skel {

// Somebody's skeleton as our clips want it: the joints that have a part (findJointRoles(),
// findQuadrupedRoles()), by our names, each below the nearest one above that has a part too, and turned about
// the vertical so that the figure looks as the clips' own does (a biped at the viewer, +z, an animal to the
// left, -x). Joints without a part move as one with the next above them, so that what holds for this skeleton
// holds for theirs.
struct RoleFigure {
  Skeleton skeleton;
  std::vector<int> theirs;     // one a joint of `skeleton`: which of theirs it is
  std::vector<int> carriers;   // one a joint of theirs: which of `skeleton` moves it
  Eigen::Quaterniond to_ours;  // the turn
};

// Nothing: neither arms and legs nor four legs could be told.
std::optional<RoleFigure> roleFigure(const Skeleton& theirs);

// Made for this body plan, or for none and by its names of joints.
bool isFor(const Clip& clip, const RoleFigure& figure);

// Whether it moves no others than its body plan's joints, most of which are there (no tail, no wagging; but
// walking), of a user's own clip one; and all are that it puts on the ground.
bool hasParts(const Clip& clip, const RoleFigure& figure);

// Both.
bool fits(const Clip& clip, const RoleFigure& figure);

// The clip for the rest pose of `theirs`. `shape`: of `figure.skeleton`.
Clip retargetByRoles(const Clip& clip, const RoleFigure& figure, const Skeleton& theirs,
                     const FigureShape& shape);

}  // namespace skel
