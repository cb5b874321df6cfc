// Lines and edges of colour inside a figure, on the working grid: what tells an arm from the torso behind it.
#pragma once

#include <Eigen/Core>

#include "libskel/image/image.h"

namespace skel {

// H×W pixels of three channels in 0…255, row y·W + x.
using GridColours = Eigen::Array<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

// The largest difference of any channel between a pixel and its four neighbours, relative to the range of
// brightness inside the figure (so that a pale pencil and a black pen look alike), 0…255. Only pixels of the
// mask (not 0) count, the figure's outline itself gives nothing. 0 outside the mask.
Plane8 lineStrength(const GridColours& colours, const Plane8& mask);

// Averages the pixels of the picture (over white, where it is transparent) that fall into each grid pixel.
// `corner_px` and `scale` as in WorkingGrid: grid px = (image px + 0.5 - corner_px) · scale - 0.5.
GridColours gridColours(const Image& image, const Eigen::Vector2d& corner_px, double scale, int width,
                        int height);

}  // namespace skel
