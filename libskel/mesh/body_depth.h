// How deep the parts of a drawn body are: what the silhouette alone cannot tell.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "libskel/image/image.h"

namespace skel {

// What is around a bone. The height z of the inflated body is sqrt(u) with −Δu + (source / most²)·u = source:
// a tube of radius r comes out about sqrt(source / 2)·r high, a ball of it sqrt(source / 4)·r, and nothing
// higher than `most`.
struct DepthBone {
  Eigen::Vector2d from = Eigen::Vector2d::Zero(), to = Eigen::Vector2d::Zero();  // image px
  double radius_px = 1;                                                          // of the flesh around it
  double source = 2.5;
  double most_px = 1;
  int layer = 0;  // FigurePiece::layer of the limb that it is in, 0 of trunk and head
  // How far the rim lies before the middle of the body, as a share of its half depth: what faces the viewer
  // shows its own colours to him and those of its back to who looks from the side.
  double forward = 0;
  bool trunk = false;  // of the spine, or where a limb hangs on the trunk
  // How far its ends lie before the drawing's plane: legs of who is drawn from the side.
  double from_aside_px = 0, to_aside_px = 0;
};

// A foot that stands, drawn from the front: it becomes a shoe with a flat sole.
struct DepthFoot {
  Eigen::Vector2d knee = Eigen::Vector2d::Zero(), foot = Eigen::Vector2d::Zero();  // joints, image px
  double radius_px = 1;                                                            // of the shin
  int layer = 0;
};

// Between the chin and the shoulders of who is drawn from the front.
struct DepthNeck {
  Eigen::Vector2d at = Eigen::Vector2d::Zero(), up = Eigen::Vector2d::UnitY();  // image px; unit, to the head
  double reach_px = 1;  // along it, to chin and shoulders
  double wide_px = 1;   // half
  double depth_px = 1;  // half
};

// A cross-section, px across from the line that its DepthSections give.
struct DepthEllipse {
  double middle_px = 0, half_px = 0;
  double round = 0;  // depth by width
};

// Trunk and skirt of who is drawn from the front.
struct DepthSections {
  Eigen::Vector2d top = Eigen::Vector2d::Zero(), down = Eigen::Vector2d::UnitY();  // image px; unit
  double step_px = 1;                                                              // from one to the next
  std::vector<DepthEllipse> ellipses;
};

// Capes, wings and tails of who is drawn from the front.
struct DepthCapes {
  Plane8 mask;           // of the image's size
  double thickness = 1;  // share of the depth that they would have as flesh
};

struct BodyDepth {
  std::vector<DepthBone> bones;  // none: all of the body is as round as its outline
  std::vector<DepthFoot> feet;
  std::optional<DepthNeck> neck;
  std::optional<DepthSections> sections;
  std::optional<DepthCapes> capes;
};

// The bones' `source`, most half depth and `forward` at one point, blended from bone to bone; beyond the
// flesh of all (brims, capes, the width of a skirt) the body gets thin.
struct DepthThere {
  double source = 2.5;
  double most_px = 0;  // 0: no bound
  double forward = 0;
};
DepthThere depthAt(const std::vector<DepthBone>& bones, const Eigen::Vector2d& p);

// How far before the drawing's plane the middle of the body lies at one point, px, by all bones but the
// trunk's.
double asideAt(const std::vector<DepthBone>& bones, const Eigen::Vector2d& p);

}  // namespace skel
