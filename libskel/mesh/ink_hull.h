// The line that is drawn around a figure, for whoever looks from elsewhere than the front: an inverted hull,
// the surface a line's width farther out and turned inside out, of which only the far side is painted.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "libskel/image/image.h"
#include "libskel/mesh/triangle_mesh.h"

namespace skel {

struct OutlineSample;

// Of a figure whose rim is drawn with a line most of the way round; else of no width. `rim`: of all that the
// figure consists of. `long_px`: the figure's long side.
InkLine inkLine(const Image& image, const std::vector<OutlineSample>& rim, double long_px, double m_per_px);

// #V, m: how far the hull stands off each vertex along its normal. In the drawing's plane, where the front
// shows the line as it is drawn, less than elsewhere. Empty: there is no line. `mesh`: in its rest pose.
Eigen::VectorXf inkReach(const TriangleMesh& mesh);

// For a painter.
struct InkHull {
  Eigen::MatrixX3f vertices;   // as many as the mesh has
  Eigen::MatrixX3i triangles;  // #F×3: those that may be seen, turned inside out
};

// In a pose with these vertexNormals(), `reach_m` by inkReach() and not empty, `eye` in the model frame, m:
// moved away from the `eye`, along the line of sight, so that it is seen only past what it surrounds.
InkHull inkHull(const Eigen::MatrixX3f& vertices, const Eigen::MatrixX3i& triangles,
                const Eigen::MatrixX3f& normals, const Eigen::VectorXf& reach_m, const Eigen::Vector3f& eye);

}  // namespace skel
