#include "libskel/skin/solid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libskel/skin/falloff.h"

namespace skel {
namespace {

constexpr float kFinest = 128, kCoarsest = 40;  // cells along the longest side
constexpr double kMostSamples = 4e6;            // of the surface
enum Kind : char { kInside, kSurface, kOutside };

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const Eigen::Vector3f a = mesh.vertices.row(mesh.triangles(t, 0));
    const Eigen::Vector3f u = mesh.vertices.row(mesh.triangles(t, 1)).transpose() - a,
                          v = mesh.vertices.row(mesh.triangles(t, 2)).transpose() - a;
    sum += 0.5 * static_cast<double>(std::sqrt((u.squaredNorm() * v.squaredNorm())));
  }
  return sum;
}

}  // namespace

Solid::Solid(const TriangleMesh& mesh) {
  const Eigen::Array3f low = mesh.vertices.colwise().minCoeff(), high = mesh.vertices.colwise().maxCoeff();
  const float longest = std::max((high - low).maxCoeff(), 1e-6f);
  cell_m_ = std::clamp(meanEdge(mesh), longest / kFinest, longest / kCoarsest);
  // Four samples a square cell.
  cell_m_ = std::max(cell_m_, static_cast<float>(std::sqrt(8 * area(mesh) / kMostSamples)));
  low_ = low - 1.5f * cell_m_;
  for (int k = 0; k < 3; ++k) count_[k] = static_cast<int>((high[k] - low_[k]) / cell_m_) + 3;
  std::vector<char> kind(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2], kInside);
  markSurface(mesh, kind);

  // What the outermost cell reaches across sides is outside.
  const std::array<int, 3> stride{1, count_[0], count_[0] * count_[1]};
  std::vector<int> open{0};
  kind[0] = kOutside;
  while (!open.empty()) {
    const int cell = open.back();
    open.pop_back();
    const std::array<int, 3> at{cell % count_[0], cell / count_[0] % count_[1], cell / stride[2]};
    for (int axis = 0; axis < 3; ++axis) {
      for (const int way : {-1, 1}) {
        if (at[axis] + way < 0 || at[axis] + way >= count_[axis]) continue;
        const int to = cell + way * stride[axis];
        if (kind[to] != kInside) continue;
        kind[to] = kOutside;
        open.push_back(to);
      }
    }
  }
  number_.assign(kind.size(), -1);
  for (std::size_t cell = 0; cell < kind.size(); ++cell) {
    if (kind[cell] == kOutside) continue;
    number_[cell] = static_cast<int>(cells_.size());
    cells_.push_back(static_cast<int>(cell));
  }
  int next = 0;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        offsets_[next] = x * stride[0] + y * stride[1] + z * stride[2];
        lengths_[next++] = cell_m_ * std::sqrt(static_cast<float>(x * x + y * y + z * z));
      }
    }
  }
}

void Solid::markSurface(const TriangleMesh& mesh, std::vector<char>& kind) const {
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const Eigen::Vector3f a = mesh.vertices.row(mesh.triangles(t, 0)),
                          b = mesh.vertices.row(mesh.triangles(t, 1)),
                          c = mesh.vertices.row(mesh.triangles(t, 2));
    const Eigen::Vector3f u = b - a, v = c - a;
    const int steps = static_cast<int>(2 * std::max({u.norm(), v.norm(), (c - b).norm()}) / cell_m_) + 1;
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        int cell = 0;
        const float s = static_cast<float>(i) / static_cast<float>(steps),
                    r = static_cast<float>(j) / static_cast<float>(steps);
        if (cellOf(a + s * u + r * v, cell)) kind[cell] = kSurface;
      }
    }
  }
  for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i) {
    int cell = 0;
    if (cellOf(mesh.vertices.row(i), cell)) kind[cell] = kSurface;
  }
}

bool Solid::cellOf(const Eigen::Vector3f& p, int& cell) const {
  const Eigen::Array3f at = (p.array() - low_) / cell_m_;
  for (int k = 0; k < 3; ++k)
    if (!(at[k] >= 0 && at[k] < static_cast<float>(count_[k]))) return false;
  cell = static_cast<int>(at.x()) +
         count_[0] * (static_cast<int>(at.y()) + count_[1] * static_cast<int>(at.z()));
  return true;
}

int Solid::at(const Eigen::Vector3f& p) const {
  int cell = 0;
  return cellOf(p, cell) ? number_[cell] : -1;
}

Eigen::Vector3f Solid::center(int cube) const {
  const int cell = cells_[static_cast<std::size_t>(cube)];
  const Eigen::Array3f at(static_cast<float>(cell % count_[0]),
                          static_cast<float>(cell / count_[0] % count_[1]),
                          static_cast<float>(cell / count_[0] / count_[1]));
  return low_ + cell_m_ * (at + 0.5f);
}

int Solid::nearest(const Eigen::Vector3f& p) const {
  int best = 0;
  float least = std::numeric_limits<float>::infinity();
  for (int cube = 0; cube < size(); ++cube) {
    const float distance2 = (center(cube) - p).squaredNorm();
    if (distance2 < least) least = distance2, best = cube;
  }
  return best;
}

bool Solid::sees(const Eigen::Vector3f& a, const Eigen::Vector3f& b) const {
  const int steps = 1 + static_cast<int>(std::min(2 * (b - a).norm() / cell_m_, 1e6f));
  for (int k = 0; k <= steps; ++k)
    if (at(a + (b - a) * (static_cast<float>(k) / static_cast<float>(steps))) < 0) return false;
  return true;
}

}  // namespace skel
