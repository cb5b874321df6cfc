// E. Rémy, É. Thiel, "Exact medial axis with Euclidean distance" (2005): a table of the smallest disc at a
// neighbour that contains a given disc, as sets of pixels.
#include "libskel/candidates/maximal_discs.h"

#include <algorithm>
#include <cmath>

namespace skel {
namespace {

constexpr int kReach = 2;

// containing[r²] = the smallest R² such that every pixel x with |x|² < r² has |x − v|² < R².
std::vector<int> containingDiscs(const Eigen::Array2i& v, int largest_squared) {
  const int reach = static_cast<int>(std::sqrt(largest_squared)) + 1;
  std::vector<int> farthest(static_cast<size_t>(largest_squared) + 1, 0);  // by |x|², largest |x − v|²
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      const int norm = x * x + y * y;
      if (norm >= largest_squared) continue;
      int& far = farthest[static_cast<size_t>(norm)];
      far = std::max(far, (x - v.x()) * (x - v.x()) + (y - v.y()) * (y - v.y()));
    }
  std::vector<int> containing(static_cast<size_t>(largest_squared) + 1, 1);
  for (size_t squared = 1; squared < containing.size(); ++squared)
    containing[squared] = std::max(containing[squared - 1], farthest[squared - 1] + 1);
  return containing;
}

}  // namespace

std::vector<Eigen::Array2i> maximalDiscs(const DistanceField& distance) {
  using SquaredField = Eigen::Array<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const SquaredField squared = (distance * distance).round().cast<int>();
  const int largest = squared.size() ? squared.maxCoeff() : 0;
  const int height = static_cast<int>(squared.rows()), width = static_cast<int>(squared.cols());
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> maximal = squared > 0;
  for (int dy = -kReach; dy <= kReach; ++dy)
    for (int dx = -kReach; dx <= kReach; ++dx) {
      if (dx == 0 && dy == 0) continue;
      const std::vector<int> containing = containingDiscs({dx, dy}, largest);
      for (int y = std::max(0, -dy); y < std::min(height, height - dy); ++y)
        for (int x = std::max(0, -dx); x < std::min(width, width - dx); ++x)
          if (squared(y + dy, x + dx) >= containing[static_cast<size_t>(squared(y, x))])
            maximal(y, x) = false;
    }
  std::vector<Eigen::Array2i> centres;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (maximal(y, x)) centres.emplace_back(x, y);
  return centres;
}

}  // namespace skel
