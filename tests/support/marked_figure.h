// A synthetic figure whose joints are marked by a dot of a colour of their own, to see where a drawing's
// joints come to lie when it is changed.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "libskel/image/image.h"
#include "tests/support/synthetic_figure.h"

namespace skel {

struct MarkedFigure {
  Image image;
  Plane8 mask;
  std::vector<std::string> names;
  std::vector<Eigen::Vector2d> joints;
};

inline std::array<std::uint8_t, 3> markOf(std::size_t joint) {
  return {static_cast<std::uint8_t>(joint % 3 * 120), static_cast<std::uint8_t>(joint / 3 % 3 * 120),
          static_cast<std::uint8_t>(joint / 9 * 120)};
}

inline MarkedFigure markedFigure(const std::vector<std::string>& names, const CapsuleFigure& figure = {}) {
  constexpr int kDot_px = 9;
  MarkedFigure out;
  out.mask = capsuleMask(figure);
  out.names = names;
  const Skeleton skeleton = capsuleSkeleton(figure);
  for (const std::string& name : names)
    out.joints.push_back(skeleton.joints[static_cast<std::size_t>(skeleton.index(name))].image);
  out.image = Image(figure.size, figure.size);
  for (int y = 0; y < figure.size; ++y) {
    for (int x = 0; x < figure.size; ++x) {
      std::uint8_t* p = out.image.pixel(x, y);
      std::fill_n(p, 4, std::uint8_t{255});
      for (std::size_t j = 0; j < out.joints.size(); ++j) {
        if ((out.joints[j] - Eigen::Vector2d(x, y)).norm() <= kDot_px) std::copy_n(markOf(j).begin(), 3, p);
      }
    }
  }
  return out;
}

// Whether a pixel shows the joint's mark.
inline bool showsMark(const std::uint8_t* rgb, std::size_t joint) {
  int difference = 0;
  for (std::size_t c = 0; c < 3; ++c) difference = std::max(difference, std::abs(rgb[c] - markOf(joint)[c]));
  return difference <= 40;
}

}  // namespace skel
