// How far before the others a piece of a figure lies.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "libskel/mesh/figure_piece.h"
#include "libskel/mesh/planar_mesh.h"

namespace skel {

// A height over the drawing, at points one cell apart; 0 where nothing is.
class Relief {
 public:
  // Over the points from `low` to `high`, image px.
  Relief(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double cell_px);

  // Raises it to the surface where that is higher; `z`: of the inner vertices, the rim has `rim_z`.
  void raise(const PlanarMesh& mesh, const Eigen::VectorXd& z, const std::vector<double>& offset);

  double at(const Eigen::Vector2d& p) const;  // between the points linear; 0 beyond them

 private:
  friend std::vector<double> layOver(const Relief& below, const PlanarMesh& mesh,
                                     const Eigen::VectorXd& behind, const FigurePiece& piece);
  Eigen::Vector2d low_;
  double cell_px_;
  Eigen::ArrayXXd height_;  // rows × columns
};

// By how much each vertex of the piece is brought forward so that its back lies before `below` wherever
// `piece.over` asks for it; to where it does not, it slopes down.
// `behind`: of all vertices, how far the back lies behind the drawing, px.
std::vector<double> layOver(const Relief& below, const PlanarMesh& mesh, const Eigen::VectorXd& behind,
                            const FigurePiece& piece);

}  // namespace skel
