// Figures that are drawn in several pieces: a head that does not touch the neck, balls for hands, gaps in a
// pencil line.
#pragma once

#include <string>
#include <vector>

#include "libskel/image/image.h"

namespace skel {

// Share of its convex hull that a figure does not fill: 0.3 and more where limbs stand out. 255 on the
// figure.
double openShare(const Plane8& figure);

struct PieceOptions {
  // A piece belongs to the figure across a gap of at most this share of the long side of both together.
  double widest_gap = 0.08;
  // Share of the figure's area that a piece needs, else it is a speck and left out.
  double smallest_share = 0.002;
  // Flat things under the feet (a shadow, a line of ground) are no pieces of the figure. Off for a mask that
  // was painted by hand: what it holds belongs to it.
  bool leave_ground = true;
  // What has no limbs (a house, a sun, a heart) comes after figures that are not too much smaller.
  bool limbs_first = false;
  // Paper that shines through long narrow gaps of a figure is taken for it.
  bool close_slits = false;
};

// One figure of a picture: its pieces joined by bridges across the gaps.
struct JoinedFigure {
  Plane8 mask;            // 255 on the figure and on the bridges; 4-connected; of the figure's box alone
  Plane8 bridges;         // the same, 255 on bridges alone; empty if there are none
  int left = 0, top = 0;  // of that box in the picture
  int pieces = 1;

  // `own`, one of these masks, at the size of the picture.
  Plane8 inPicture(const Plane8& own, Eigen::Index height, Eigen::Index width) const;
};

// The figures of a picture, the largest first (but see `limbs_first`). `foreground`: not 0 on anything that
// is drawn. Pieces become one figure where they are near each other; people side by side, each as tall as the
// other, stay apart. Parts less than `min_long_side_px` high and wide are left out.
std::vector<JoinedFigure> joinPieces(const Plane8& foreground, int min_long_side_px,
                                     const PieceOptions& options = {});

}  // namespace skel
