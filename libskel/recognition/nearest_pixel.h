// The pixel of a figure that is nearest to a point.
//
// A quadtree of whether there is any (R. Finkel, J. Bentley 1974), searched by branch and bound: the time
// hardly depends on how far the figure is.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "libskel/image/image.h"

namespace skel {

class NearestPixel {
 public:
  // `mask` is looked at as long as this lives; some pixel of it is not 0.
  explicit NearestPixel(const Plane8& mask);

  // The nearest pixel of the figure, or `point` itself where its pixel is of the figure. Image px.
  Eigen::Vector2d to(const Eigen::Vector2d& point) const;

 private:
  struct Search;
  void look(std::size_t level, Eigen::Index x, Eigen::Index y, Search& search) const;
  const Plane8& cells(std::size_t level) const { return level == 0 ? mask_ : above_[level - 1]; }

  const Plane8& mask_;
  std::vector<Plane8> above_;  // of 2×2 cells each, up to a single one
};

// Whether the pixel of this point is of the figure.
bool onFigure(const Plane8& mask, const Eigen::Vector2d& point);

}  // namespace skel
