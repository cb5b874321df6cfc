// Cutting a polygon of a model into triangles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace skel {

// corners.size() − 2 triangles, as indices into `corners`, turning as the polygon does; of a convex one the
// fan around its first corner. The polygon may be concave, and should be nearly flat. If it crosses itself,
// it is cut somehow. Time goes with the square of the number of corners. At least 3 corners.
std::vector<std::array<int, 3>> cutPolygon(const std::vector<Eigen::Vector3f>& corners);

}  // namespace skel
