// Which part of the figure each pixel is: what the part net says, with borders on the drawing's own lines.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "libskel/image/image.h"
#include "libskel/layers/part_net.h"
#include "libskel/mesh/outline.h"

namespace skel {

// The figure's box as the parts are looked for in it. All planes have one size.
struct PartPicture {
  PixelBox box;                   // of the image
  double scale = 1;               // its px a px of the image, at most 1
  std::vector<std::uint8_t> rgb;  // over white, three bytes a px, row by row
  Plane8 mask;                    // 255 on the figure
  Plane8 part;                    // a Part, outside of the figure the nearest
  // Of each limb: mean probability of its pixels, and that it lies before what it overlaps.
  std::array<double, 4> sure{}, before{};
  double range = 0;  // of brightness on the figure, at least 40
};

// `mask`: 255 on the figure, somewhere; `skeleton` in image px, the corner of the first px at 0.
PartPicture findParts(const Image& image, const Plane8& mask, const PartSkeleton& skeleton,
                      const PartNet& net);

}  // namespace skel
