#include "libskel/recognition/bone_coverage.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "libskel/candidates/candidates.h"

namespace skel {
namespace {

using Eigen::Vector2d;

// Ways within a mask are counted in fifths of a px: 5 to a neighbour, 7 to a diagonal one (Borgefors 1986).
constexpr int kStraight = 5, kDiagonal = 7;

class WaysInside {
 public:
  explicit WaysInside(const Plane8& mask) : mask_(mask), way_(static_cast<std::size_t>(mask.size()), kFar) {}

  void startIn(const Vector2d& centre, double radius) {
    const auto first = [](double c) { return std::max(0, static_cast<int>(std::ceil(c))); };
    const auto last = [](double c, Eigen::Index size) {
      return std::min(static_cast<int>(size) - 1, static_cast<int>(std::floor(c)));
    };
    for (int y = first(centre.y() - radius); y <= last(centre.y() + radius, mask_.rows()); ++y)
      for (int x = first(centre.x() - radius); x <= last(centre.x() + radius, mask_.cols()); ++x)
        if ((Vector2d(x, y) - centre).squaredNorm() <= radius * radius) start(x, y);
  }

  // Of each pixel of the figure that can be reached; farther ones later.
  template <class Visit>
  void walk(const Visit& visit) {
    // Bucket k of a ring holds what lies at a way of k, for all ways that a step may lead to.
    for (int way = 0, waiting = static_cast<int>(ring_[0].size()); waiting > 0; ++way) {
      std::vector<int>& bucket = ring_[static_cast<std::size_t>(way % kRing)];
      for (std::size_t k = 0; k < bucket.size(); ++k) {
        const int at = bucket[k];
        --waiting;
        if (way_[static_cast<std::size_t>(at)] != way) continue;  // there is a shorter one
        visit(way / double(kStraight));
        waiting += stepFrom(at, way);
      }
      bucket.clear();
    }
  }

 private:
  static constexpr int kRing = kDiagonal + 1, kFar = 1 << 30;

  void start(int x, int y) {
    const int at = y * static_cast<int>(mask_.cols()) + x;
    if (mask_(y, x) == 0 || way_[static_cast<std::size_t>(at)] == 0) return;
    way_[static_cast<std::size_t>(at)] = 0;
    ring_[0].push_back(at);
  }

  // Returns how many neighbours were put into buckets.
  int stepFrom(int at, int way) {
    const int width = static_cast<int>(mask_.cols()), x = at % width, y = at / width;
    int added = 0;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int nx = x + dx, ny = y + dy;
        if (nx < 0 || ny < 0 || nx >= width || ny >= mask_.rows() || mask_(ny, nx) == 0) continue;
        const int next = way + (dx != 0 && dy != 0 ? kDiagonal : kStraight);
        int& known = way_[static_cast<std::size_t>(ny * width + nx)];
        if (next >= known) continue;
        known = next;
        ring_[static_cast<std::size_t>(next % kRing)].push_back(ny * width + nx);
        ++added;
      }
    }
    return added;
  }

  const Plane8& mask_;
  std::vector<int> way_;
  std::array<std::vector<int>, kRing> ring_;
};

}  // namespace

BoneCoverage boneCoverage(const Plane8& mask, const std::vector<std::pair<Vector2d, Vector2d>>& bones) {
  const DistanceField distance = distanceField(mask);
  WaysInside ways(mask);
  BoneCoverage coverage;
  for (const auto& [a, b] : bones) {
    const int steps = std::max(1, static_cast<int>(std::lround((b - a).norm())));
    int outside = 0;
    for (int k = 0; k <= steps; ++k) {
      const Vector2d p = a + (b - a) * (static_cast<double>(k) / steps);
      const auto x = std::lround(p.x()), y = std::lround(p.y());
      const bool inside = x >= 0 && y >= 0 && x < mask.cols() && y < mask.rows() && mask(y, x) != 0;
      if (inside) ways.startIn(p, distance(y, x));
      outside += !inside;
    }
    coverage.outside.push_back(static_cast<double>(outside) / (steps + 1));
  }
  int far = 0;
  ways.walk([&](double way) {
    far += way > BoneCoverage::kNextTo;
    coverage.farthest = way;
  });
  coverage.uncovered =
      static_cast<double>(far) / static_cast<double>(std::max<Eigen::Index>(1, (mask != 0).count()));
  return coverage;
}

}  // namespace skel
