// Figures of all frames at one size and place.
//
// Patent CN102231209A: the area becomes a constant, the middle of points of the outline the middle of the
// picture. The patent prints the ratio of the areas the other way round.
#pragma once

#include <cstdint>

#include "libskel/video/outline_distance.h"

namespace skel {

// normalised = scale · original + shift, image px.
struct FrameTransform {
  double scale = 1;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();

  Eigen::Vector2d apply(const Eigen::Vector2d& p) const { return scale * p + shift; }
  Eigen::Vector2d invert(const Eigen::Vector2d& p) const { return (p - shift) / scale; }
};

inline constexpr int kOutlineSamples = 200;  // t

// Scales by √(area / the figure's area) and takes the centroid of kOutlineSamples points of the outline,
// drawn with `seed`, to the middle of the picture. A frame without a figure stays as it is. `area_px` > 0.
FrameTransform normalizeFigure(const FrameOutline& outline, double area_px, std::uint64_t seed = 1);

// The picture so transformed, of the same size; bilinear, transparent where there was nothing.
Image transformed(const Image& image, const FrameTransform& transform);

}  // namespace skel
