#include "libskel/skeleton/moved_joints.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "libskel/core/check.h"
#include "libskel/core/rng.h"

namespace skel {
namespace {

using Eigen::Vector2d;
using Map = Eigen::Matrix<double, 2, 3>;  // model from (image, 1)

constexpr double kSlack_px = 0.5;  // files keep hundredths of a pixel, and three of them make the map
// Samples times joints: all samples of 100 joints, 20,000 of the 1000 that a template may have.
constexpr double kMostLooks = 2e7;

Map mapThrough(const std::vector<Vector2d>& image, const std::vector<Vector2d>& position,
               const std::array<int, 3>& sample) {
  Eigen::Matrix3d from;
  Map to;
  for (int k = 0; k < 3; ++k) {
    from.col(k) << image[static_cast<size_t>(sample[k])], 1;
    to.col(k) = position[static_cast<size_t>(sample[k])];
  }
  return to * from.inverse();
}

std::vector<int> misfits(const Map& map, const std::vector<Vector2d>& image,
                         const std::vector<Vector2d>& position) {
  std::vector<int> result;
  const double slack_m = kSlack_px * std::sqrt(std::abs(map.leftCols<2>().determinant()));
  for (size_t i = 0; i < image.size(); ++i)
    if ((map * image[i].homogeneous() - position[i]).norm() > slack_m) result.push_back(static_cast<int>(i));
  return result;
}

double squaredExtent(const std::vector<Vector2d>& points) {
  Vector2d low = points.front(), high = low;
  for (const Vector2d& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return (high - low).squaredNorm();
}

}  // namespace

std::vector<int> movedJoints(const std::vector<Vector2d>& image, const std::vector<Vector2d>& position) {
  SKEL_CHECK_EQ(image.size(), position.size());
  const int count = static_cast<int>(image.size());
  if (count < 5 || squaredExtent(position) < 1e-6) return {};
  const double wide_px2 = 0.02 * squaredExtent(image);  // a thin sample makes a poor map
  std::vector<int> fewest;
  bool any = false;
  const auto look = [&](int a, int b, int c) {
    const Vector2d ab = image[static_cast<size_t>(b)] - image[static_cast<size_t>(a)],
                   ac = image[static_cast<size_t>(c)] - image[static_cast<size_t>(a)];
    if (std::abs(ab.x() * ac.y() - ab.y() * ac.x()) < wide_px2) return;
    const Map map = mapThrough(image, position, {a, b, c});
    if (std::abs(map.leftCols<2>().determinant()) < 1e-12) return;
    std::vector<int> off = misfits(map, image, position);
    if (!any || off.size() < fewest.size()) fewest = std::move(off);
    any = true;
  };
  const double n = count, samples = n * (n - 1) * (n - 2) / 6;
  if (samples * n <= kMostLooks) {
    for (int a = 0; a < count; ++a)
      for (int b = a + 1; b < count; ++b)
        for (int c = b + 1; c < count; ++c) look(a, b, c);
    return fewest;
  }
  Rng rng(0);
  const auto joint = [&] { return static_cast<int>(rng.below(static_cast<std::uint32_t>(count))); };
  for (double looks = 0; looks < kMostLooks; looks += n) {
    const int a = joint(), b = joint(), c = joint();
    if (a != b && b != c && c != a) look(a, b, c);
  }
  return fewest;
}

}  // namespace skel
