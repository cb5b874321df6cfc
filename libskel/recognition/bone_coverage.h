// Which part of a figure its bones explain. Limbs that no bone goes into speak against a skeleton, as do
// bones beside the figure.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "libskel/image/image.h"

namespace skel {

struct BoneCoverage {
  std::vector<double> outside;  // by bone, [0, 1]: the share of its length that lies outside the figure
  // A bone covers the discs around its points that touch the outline. What lies beyond them, by the way
  // inside the figure:
  double uncovered = 0;  // [0, 1]: share of the figure's pixels more than kNextTo away
  double farthest = 0;   // px

  static constexpr double kNextTo = 4;  // px
};

// `mask` (not 0 on the figure) is of the working grid's size, `bones` are pairs of points in its px.
BoneCoverage boneCoverage(const Plane8& mask,
                          const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& bones);

}  // namespace skel
