// Drawings pasted onto others: things that figures hold, wear or lean on, and second figures beside them.
#pragma once

#include <vector>

#include "libskel/core/rng.h"
#include "trainer/figures/drawing.h"
#include "trainer/figures/warped_drawing.h"

namespace skel {

// Pieces of drawings, turned and cut out, where they touch the figure or stand behind it must fit into so
// many times its long side around it.
inline constexpr double kThingMargin = .25;

// Puts a piece of another drawing to one of the figure's hands or feet, or anywhere on it, before it or
// behind it; none where it would cover too much. `long_side`: of the figure, px. Joints that it covers are no
// longer `visible`.
void pasteThing(Rng& rng, const FigurePlan& plan, const SmallDrawing& drawing, int long_side,
                WarpedDrawing& figure, std::vector<bool>& visible);

// Puts another figure beside it, about as large, so that they touch or overlap a little. It may need as much
// room again.
void pasteNeighbour(Rng& rng, const SmallDrawing& drawing, int long_side, WarpedDrawing& figure);

}  // namespace skel
