// Inside the room: which limb moves which pixel of a sheet that holds several.
#pragma once

#include <vector>

#include "libskel/cutout/cut_out.h"
#include "libskel/layers/limb_bones.h"

namespace skel {

// Of the body plan's limb, from 1, in the image.
LimbBones limbBones(const DrawnFigure& figure, std::size_t limb);

// Of the image's size: the limb that a pixel is of, from 1, with what it holds; 0: none, or one that is a
// sheet of its own or that moves nothing. Specks far from the rest of their limb are what is around them.
Plane8 limbPlane(const DrawnFigure& figure, const std::vector<FigurePiece>& pieces);

// One a limb, from 1: how wide it is, px, in the mean; 0 if it is not in the plane.
std::vector<double> limbWidths(const DrawnFigure& figure, const Plane8& limbs);

}  // namespace skel
