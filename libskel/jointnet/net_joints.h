// The joints that the net finds, in the order of its outputs.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

namespace skel {

inline constexpr int kNetJoints = 14;
inline constexpr std::array<std::string_view, kNetJoints> kNetJointNames = {
    "head",      "body",           "left_shoulder", "left_elbow", "left_hand", "left_hip",   "left_knee",
    "left_foot", "right_shoulder", "right_elbow",   "right_hand", "right_hip", "right_knee", "right_foot"};
// The same joint of the other side.
inline constexpr std::array<int, kNetJoints> kMirroredJoint = {0, 1, 8, 9, 10, 11, 12, 13, 2, 3, 4, 5, 6, 7};

using NetJointPositions = std::array<Eigen::Vector2d, kNetJoints>;

}  // namespace skel
