// A textured triangle mesh and how the drawing lies on it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "libskel/image/image.h"

namespace skel {

// Takes points of the drawing into the model frame (m, y up, +z to the viewer): x and y; z is for others to
// choose.
struct ModelFromImage {
  Eigen::Vector2d scale = Eigen::Vector2d::Ones();      // m per image px, across and down; both positive
  Eigen::Vector2d origin_px = Eigen::Vector2d::Zero();  // the image point at model x = 0, y = 0
  double turned_rad = 0;  // how far the figure is turned clockwise in the drawing; the model stands upright

  Eigen::Vector2d operator()(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d d = upright(p - origin_px);
    return {d.x() * scale.x(), -d.y() * scale.y()};
  }
  Eigen::Vector2d inverse(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d d(p.x() / scale.x(), -p.y() / scale.y());
    if (turned_rad == 0) return d + origin_px;
    return Eigen::Rotation2Dd(turned_rad) * d + origin_px;
  }
  // Directions of the drawing, turned back.
  Eigen::Vector2d upright(const Eigen::Vector2d& d) const {
    if (turned_rad == 0) return d;
    return Eigen::Rotation2Dd(-turned_rad) * d;
  }
};

// The line that is drawn around a figure (ink_hull.h).
struct InkLine {
  float width_m = 0;                              // 0: none
  Eigen::Vector3f rgb = Eigen::Vector3f::Zero();  // 0…255
};

// Triangles are counter-clockwise seen from outside. One that inflate() made is closed and 2-manifold; one of
// a user's own need not be.
struct TriangleMesh {
  Eigen::MatrixX3f vertices;   // #V×3, m, model frame
  Eigen::MatrixX3i triangles;  // #F×3
  Eigen::MatrixX2f uv;  // #V×2, glTF: origin at the texture's top left corner, +v down; empty: no texture
  // Where the back wears another part of the texture than the front: the triangles from `first_back` on take
  // their coordinates from here. The mesh stays closed; splitSeams() parts it for formats. Empty: all take
  // uv.
  Eigen::MatrixX2f back_uv;  // #V×2
  Eigen::Index first_back = 0;
  Image texture;
  InkLine ink;
  ModelFromImage model_from_image;
  // #V, of a mesh of several closed bodies: which one, 0 the trunk's, else the limb's that a vertex belongs
  // to (FigurePiece::layer). Empty: one skin.
  Eigen::VectorXi layer;
  // #V, of a mesh that was read from a file of `file_vertices` vertices: which of them, from 0, each one is.
  // Seams have several of one; what no face needs is left out. Empty: the file's, or not from a file.
  Eigen::VectorXi file_vertex;
  Eigen::Index file_vertices = 0;

  Eigen::RowVector2f uvOf(Eigen::Index triangle, int corner) const {
    const bool back = back_uv.rows() > 0 && triangle >= first_back;
    return (back ? back_uv : uv).row(triangles(triangle, corner));
  }
};

// From the origin, in the units of a file, of all that it holds: what is farther is refused.
inline constexpr double kFarthest = 1e6;

// The height of a model that skel makes.
inline constexpr double kModelHeight_m = 1.7;

}  // namespace skel
