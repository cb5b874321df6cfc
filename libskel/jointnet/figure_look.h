// What the inside of a figure looks like on the working grid: lines and colours, which tell an arm from the
// torso behind it and a hand from a wing.
#pragma once

#include <Eigen/Core>
#include <array>

#include "libskel/image/image.h"

namespace skel {

// H×W pixels of three channels in 0…255, row y·W + x.
using GridColours = Eigen::Array<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

// The largest difference of any channel between a pixel and its four neighbours, relative to the range of
// brightness inside the figure (so that a pale pencil and a black pen look alike), 0…255. Only pixels of the
// mask (not 0) count, the figure's outline itself gives nothing. 0 outside the mask.
Plane8 lineStrength(const GridColours& colours, const Plane8& mask);

// All planes have the mask's size, or none if nothing is known but the silhouette.
struct FigureLook {
  Plane8 lines;  // lineStrength()
  // Brightness, red against green, blue against yellow: differences to the figure's mean, which is kMeanTone.
  // Brightness is relative to its range inside the figure. kMeanTone outside the mask.
  std::array<Plane8, 3> tones;

  bool known() const { return lines.size() != 0; }
};
inline constexpr int kMeanTone = 128;

FigureLook figureLook(const GridColours& colours, const Plane8& mask);

// Averages the pixels of the picture (over white, where it is transparent) that fall into each grid pixel.
// `corner_px` and `scale` as in WorkingGrid: grid px = (image px + 0.5 - corner_px) · scale - 0.5.
GridColours gridColours(const Image& image, const Eigen::Vector2d& corner_px, double scale, int width,
                        int height);

}  // namespace skel
