// How far a pose stretches a skin.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "libskel/animation/clip.h"
#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skeleton/skeleton.h"
#include "libskel/skin/skin_weights.h"

namespace skel {

inline constexpr double kFarStretch = 3;  // what is stretched more looks torn

// A triangle at rest, in its own plane.
struct RestTriangle {
  Eigen::Index triangle;
  double area;              // m²
  Eigen::Matrix2d inverse;  // of its edges; zero where they have no area
};
// Every `step`-th triangle of a mesh.
std::vector<RestTriangle> restTriangles(const TriangleMesh& mesh, Eigen::Index step = 1);

// The largest singular value of the map that takes the triangle at rest to the posed one; 1 if it has no
// area.
double stretchOf(const RestTriangle& rest, const TriangleMesh& mesh, const Eigen::MatrixX3f& posed);

// The share of a mesh's area that a clip stretches above kFarStretch, mean over some moments of it.
struct ClipStretch {
  std::string clip;
  double share = 0;
  std::vector<double> by_joint;  // of the share, what each joint of the skeleton moves
};
// An estimate from a few moments and a part of the triangles.
std::vector<ClipStretch> clipStretches(const TriangleMesh& mesh, const Skeleton& skeleton,
                                       const SkinWeights& weights, const std::vector<Clip>& clips);

}  // namespace skel
