// A textured triangle mesh and how the drawing lies on it.
#pragma once

#include <Eigen/Core>

#include "libskel/image/image.h"

namespace skel {

// Takes points of the drawing into the model frame (m, y up, +z to the viewer): x and y; z is for others to
// choose.
struct ModelFromImage {
  Eigen::Vector2d scale = Eigen::Vector2d::Ones();      // m per image px, across and down; both positive
  Eigen::Vector2d origin_px = Eigen::Vector2d::Zero();  // the image point at model x = 0, y = 0

  Eigen::Vector2d operator()(const Eigen::Vector2d& p) const {
    return {(p.x() - origin_px.x()) * scale.x(), (origin_px.y() - p.y()) * scale.y()};
  }
  Eigen::Vector2d inverse(const Eigen::Vector2d& p) const {
    return {p.x() / scale.x() + origin_px.x(), origin_px.y() - p.y() / scale.y()};
  }
};

// Triangles are counter-clockwise seen from outside. One that inflate() made is closed and 2-manifold; one of
// a user's own need not be.
struct TriangleMesh {
  Eigen::MatrixX3f vertices;   // #V×3, m, model frame
  Eigen::MatrixX3i triangles;  // #F×3
  Eigen::MatrixX2f uv;  // #V×2, glTF: origin at the texture's top left corner, +v down; empty: no texture
  Image texture;
  ModelFromImage model_from_image;
};

// The height of a model that skel makes.
inline constexpr double kModelHeight_m = 1.7;

}  // namespace skel
