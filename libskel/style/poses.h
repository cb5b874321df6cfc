// Motions as matrices: the joints of a template down, frames across.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "libskel/skeleton/motion_file.h"
#include "libskel/skeleton/template.h"

namespace skel {

// Rows 2j and 2j + 1 hold x and y of joint j; a column is a frame.
using PoseMatrix = Eigen::MatrixXd;

// So many poses of one motion are taken to make its style from. Throws InputError that names `path`: more.
void requireFewPoses(Eigen::Index count, const std::string& path);
inline constexpr Eigen::Index kMostPoses = 10'000;

inline Eigen::Vector2d jointOf(const PoseMatrix& poses, int joint, Eigen::Index frame) {
  return poses.col(frame).segment<2>(2 * joint);
}

// In image px, 2J×m. A joint that a frame does not know lies between its places in the frames before and
// after, by time. `path` is the name that complaints use. Throws InputError: a joint that no frame knows.
PoseMatrix posesOf(const MotionFile& motion, const SkeletonTemplate& body_plan, const std::string& path);

// Where bones point: unit vectors from the parent to the joint, 2J×m; zero for the root. A bone of length 0
// points as that of its parent, or up.
PoseMatrix boneDirections(const PoseMatrix& poses, const SkeletonTemplate& body_plan);

// Joints, given where bones point, their lengths (J, that of the root is not looked at) and where the root is
// (2×m).
PoseMatrix posesFromBones(const PoseMatrix& directions, const Eigen::VectorXd& lengths,
                          const Eigen::Matrix2Xd& root, const SkeletonTemplate& body_plan);

// The median over the frames of each bone's length; at least a thousandth of the largest.
Eigen::VectorXd boneLengths(const PoseMatrix& poses, const SkeletonTemplate& body_plan);

// The same motion by a body whose bones have the lengths of the template's preset, in a box that holds
// whatever it does: in [0, 1], the root at (½, ½), +y down. Style is what is left: where bones point.
PoseMatrix canonicalPoses(const PoseMatrix& poses, const SkeletonTemplate& body_plan);

// As seen in a mirror: left and right change places.
PoseMatrix mirroredPoses(const PoseMatrix& poses, const SkeletonTemplate& body_plan);

// +1: the figure looks to the right of the picture, −1: to the left; nearer 0, the less it can be told. Knees
// bend forwards, elbows backwards, in the mean over the frames. In [−1, 1].
double facing(const PoseMatrix& poses, const SkeletonTemplate& body_plan);

// Whether the motion ends where it began, so that its first frame may follow its last: that step is at most
// twice as long as the longest of all others, and the motion has at least four frames.
bool isLoop(const PoseMatrix& poses);

}  // namespace skel
