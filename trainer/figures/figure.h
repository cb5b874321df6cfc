// Random figures with exact joints: what the joint net is trained on, and synthetic truth for tests.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "libskel/core/rng.h"
#include "libskel/image/image.h"
#include "libskel/jointnet/figure_look.h"
#include "trainer/figures/drawing.h"

namespace skel {

struct Figure {
  Plane8 mask;        // 255 on the figure; one 4-connected part whose box is the plane; the long side is 128
  FigureLook look;    // of what is drawn inside
  bool whole = true;  // one whole upright figure of its body plan; if not, the joints mean nothing
  std::vector<Eigen::Vector2d>
      joints;                 // as FigurePlan::joints; px of the mask, the origin at the first px's centre
  std::vector<bool> visible;  // of each joint: not covered by another part
  std::vector<bool> absent;   // of each joint: the figure has none (an animal without a tail)
  std::vector<bool> unknown;  // of each joint: nobody knows where it is; where it lies means nothing
  FigureView view = FigureView::kFront;
  int kind = 0;
};

// A drawing with known joints, small enough for many of them to be kept.
struct SmallDrawing {
  Image image;                          // the figure's box, its long side kSmallLongSide px
  Plane8 mask;                          // not 0 on the figure
  std::vector<Eigen::Vector2d> joints;  // as FigurePlan::joints; px of the image, corner of the first px at 0
  FigureView view = FigureView::kFront;
  std::vector<bool> unknown = {};  // of each joint: nobody knows where it is. Empty: all are known
};
inline constexpr int kSmallLongSide = 320;

// `mask` (as large as the image) is not 0 on the figure, at least one px; `joints` in px of the image, the
// origin at the first px's centre.
SmallDrawing smallDrawing(const Image& image, const Plane8& mask, const std::vector<Eigen::Vector2d>& joints,
                          FigureView view);

struct FigureOptions {
  std::string body_plan = "biped";  // one of figurePlans()
  std::vector<int> kinds;           // empty: all, as often as is useful for training
  double other_share = 0;  // share of figures that are not whole: other beings, things, pairs, cut-offs, and
                           // some that lie or stand on their heads
  // Of the figures `drawn_share` is one of these drawings each, in other proportions, bent, with another
  // outline, some with pieces of others pasted on; some of them cut, turned or in pairs, as many as
  // `other_share` says.
  std::vector<SmallDrawing> drawings;
  double drawn_share = 0;
};

// The same figure for the same state of rng and the same build. In a side view the limb at the left of the
// picture is called the right one, since which one is the far one cannot be seen.
Figure generateFigure(Rng& rng, const FigureOptions& options = {});

}  // namespace skel
