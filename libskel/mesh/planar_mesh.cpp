// Marching squares (W. Lorensen, H. Cline, "Marching cubes", 1987, in the plane) with the inner nodes kept as
// vertices. A cell whose inner corners touch by a corner alone is cut into two triangles: the figure is
// 4-connected. Vertices then move to where their triangles are best shaped ("smart" Laplacian smoothing,
// L. Freitag, "On combining Laplacian and optimization-based mesh smoothing techniques", 1997).
#include "libskel/mesh/planar_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "libskel/core/check.h"
#include "libskel/mesh/label_grid.h"

namespace skel {
namespace {

// Vertices on the rim keep this share of an edge from the edge's ends.
constexpr double kClearance = 0.04;
constexpr int kSmoothingPasses = 6;

// Seen in the drawing (+y down), positive if counter-clockwise.
double doubleArea(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (c.x() - a.x()) * (b.y() - a.y()) - (b.x() - a.x()) * (c.y() - a.y());
}

// 1 for an equilateral triangle, 0 for a degenerate one, negative for an inverted one.
double shape(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const double sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return 2 * std::sqrt(3.0) * doubleArea(a, b, c) / sides;
}

class Builder {
 public:
  explicit Builder(const LabelGrid& grid)
      : grid_(grid),
        node_(grid.inside.size(), -1),
        across_(grid.inside.size(), -1),
        down_(grid.inside.size(), -1) {}

  PlanarMesh build() {
    mesh_.cell_px = grid_.cell_px;
    for (int j = 0; j < grid_.rows; ++j) {
      for (int i = 0; i < grid_.columns; ++i) {
        if (!grid_.inside[grid_.index(i, j)]) continue;
        node_[grid_.index(i, j)] = static_cast<int>(mesh_.vertices.size());
        mesh_.vertices.push_back(grid_.node(i, j));
      }
    }
    mesh_.inner_count = static_cast<int>(mesh_.vertices.size());
    for (int j = 0; j + 1 < grid_.rows; ++j) {
      for (int i = 0; i + 1 < grid_.columns; ++i) cut(i, j);
    }
    return std::move(mesh_);
  }

 private:
  // The vertex where the rim crosses the edge from node (i, j) to the right, or down.
  int crossing(int i, int j, bool down) {
    const std::size_t at = grid_.index(i, j);
    int& vertex = down ? down_[at] : across_[at];
    if (vertex >= 0) return vertex;
    const LabelGrid::Crossing& crossing = down ? grid_.down[at] : grid_.across[at];
    const bool starts_inside = grid_.inside[at];
    const std::size_t inner = starts_inside ? at : (down ? grid_.index(i, j + 1) : grid_.index(i + 1, j));
    // A node that the outline alone would leave outside holds a part thinner than a cell: the rim keeps close
    // to it unless the outline says where that part ends.
    const bool thin = !grid_.in_outline[inner];
    double t;
    if (crossing.first > crossing.last) {
      t = thin ? 0.25 : 0.75;
      if (!starts_inside) t = 1 - t;
    } else {
      t = starts_inside == thin ? crossing.last : crossing.first;
    }
    t = std::clamp(t, kClearance, 1 - kClearance);
    vertex = static_cast<int>(mesh_.vertices.size());
    mesh_.vertices.push_back(
        grid_.node(i, j) + t * grid_.cell_px * (down ? Eigen::Vector2d::UnitY() : Eigen::Vector2d::UnitX()));
    return vertex;
  }

  void triangle(int a, int b, int c) { mesh_.triangles.push_back({a, b, c}); }

  void quad(int a, int b, int c, int d, bool from_a) {
    if (from_a) {
      triangle(a, b, c), triangle(a, c, d);
    } else {
      triangle(b, c, d), triangle(b, d, a);
    }
  }

  void cut(int i, int j) {
    // Counter-clockwise in the drawing: bottom left, bottom right, top right, top left; side k leads from
    // corner k to corner k + 1.
    const std::size_t corner[4] = {grid_.index(i, j + 1), grid_.index(i + 1, j + 1), grid_.index(i + 1, j),
                                   grid_.index(i, j)};
    const auto in = [&](int k) { return grid_.inside[corner[k % 4]] != 0; };
    const auto node = [&](int k) { return node_[corner[k % 4]]; };
    const auto side = [&](int k) {
      switch (k % 4) {
        case 0:
          return crossing(i, j + 1, false);
        case 1:
          return crossing(i + 1, j, true);
        case 2:
          return crossing(i, j, false);
        default:
          return crossing(i, j, true);
      }
    };
    const auto rim = [&](int a, int b) { mesh_.rim.emplace_back(a, b); };
    const int count = in(0) + in(1) + in(2) + in(3);
    if (count == 4) {
      quad(node(0), node(1), node(2), node(3), (i + j) % 2 == 0);
      return;
    }
    for (int k = 0; k < 4; ++k) {
      if (!in(k)) continue;
      const bool before = in(k + 3), after = in(k + 1);
      if (!before && !after) {  // this corner alone
        // Who asks for a crossing first makes it: the order decides its number.
        const int before_k = side(k + 3), after_k = side(k);
        triangle(node(k), after_k, before_k);
        rim(after_k, before_k);
      } else if (count == 2 && !before) {  // the corners k and k + 1
        const int a = node(k), b = node(k + 1), c = side(k + 1), d = side(k + 3);
        const auto& v = mesh_.vertices;
        quad(a, b, c, d, (v[a] - v[c]).squaredNorm() <= (v[b] - v[d]).squaredNorm());
        rim(c, d);
      } else if (count == 3 && before && after) {  // all but the corner opposite to k
        const int c = side(k + 1), d = side(k + 2);
        triangle(node(k), node(k + 1), c);
        triangle(node(k), c, d);
        triangle(node(k), d, node(k + 3));
        rim(c, d);
      }
    }
  }

  const LabelGrid& grid_;
  std::vector<int> node_, across_, down_;
  PlanarMesh mesh_;
};

// The triangles around each vertex: of v around[first[v]] to around[first[v + 1] - 1].
struct Fans {
  explicit Fans(const PlanarMesh& mesh)
      : first(mesh.vertices.size() + 1, 0), around(3 * mesh.triangles.size()) {
    for (const auto& t : mesh.triangles) {
      for (const int v : t) ++first[v + 1];
    }
    for (std::size_t v = 0; v + 1 < first.size(); ++v) first[v + 1] += first[v];
    std::vector<int> next(first.begin(), first.end() - 1);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (const int v : mesh.triangles[t]) around[next[v]++] = static_cast<int>(t);
    }
  }
  // The shape of v's worst triangle.
  double worst(const PlanarMesh& mesh, int v) const {
    double result = 1;
    for (int k = first[v]; k < first[v + 1]; ++k) {
      const auto& t = mesh.triangles[around[k]];
      result = std::min(result, shape(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]));
    }
    return result;
  }
  std::vector<int> first, around;
};

// The points where a curve of points one px apart turns sharply, within about a cell, and most of all beside.
void addCorners(const Polygon& curve, double cell_px, std::vector<Eigen::Vector2d>& corners) {
  constexpr double kSharp = 0.64;  // cosine: half of a right angle and more
  const int count = static_cast<int>(curve.size());
  const int reach = std::max(4, static_cast<int>(std::lround(0.8 * cell_px)));
  if (count < 6 * reach) return;
  const auto straight = [&](int i) {  // cosine of the turn
    const Eigen::Vector2d to = curve[i] - curve[(i + count - reach) % count],
                          on = curve[(i + reach) % count] - curve[i];
    return to.dot(on) / std::max(1e-9, to.norm() * on.norm());
  };
  for (int i = 0; i < count; ++i) {
    const double here = straight(i);
    bool sharpest = here < kSharp;
    for (int k = 1; sharpest && k <= reach; ++k)
      sharpest = straight((i + count - k) % count) > here && straight((i + k) % count) >= here;
    if (sharpest) corners.push_back(curve[i]);
  }
}

// A vertex of the rim that is near moves into each corner of the outline, where its triangles bear it.
// Returns which did.
std::vector<char> meetCorners(const std::vector<Eigen::Vector2d>& corners, const Fans& fans,
                              PlanarMesh& mesh) {
  constexpr double kNear = 0.75;   // cells
  constexpr double kShape = 0.15;  // that the triangles keep
  const auto squareOf = [&](const Eigen::Vector2d& p, int right, int down) {
    return std::pair(static_cast<int>(std::floor(p.y() / mesh.cell_px)) + down,
                     static_cast<int>(std::floor(p.x() / mesh.cell_px)) + right);
  };
  std::map<std::pair<int, int>, std::vector<int>> rim;  // by square of a cell's size
  for (int v = mesh.inner_count; v < static_cast<int>(mesh.vertices.size()); ++v)
    rim[squareOf(mesh.vertices[v], 0, 0)].push_back(v);
  std::vector<char> met(mesh.vertices.size(), 0);
  std::vector<std::pair<double, int>> near;
  for (const Eigen::Vector2d& corner : corners) {
    near.clear();
    for (int down = -1; down <= 1; ++down)
      for (int right = -1; right <= 1; ++right)
        if (const auto square = rim.find(squareOf(corner, right, down)); square != rim.end())
          for (const int v : square->second) {
            const double distance = (mesh.vertices[v] - corner).norm();
            if (!met[v] && distance < kNear * mesh.cell_px) near.emplace_back(distance, v);
          }
    std::sort(near.begin(), near.end());
    for (const auto& [distance, v] : near) {
      const Eigen::Vector2d old = mesh.vertices[v];
      mesh.vertices[v] = corner;
      met[v] = fans.worst(mesh, v) >= kShape;
      if (met[v]) break;
      mesh.vertices[v] = old;
    }
  }
  return met;
}

// Vertices near the rim and on it move where the worst of their triangles gains; those of the rim stay on the
// rim's own line, those in corners there.
void improve(const Fans& fans, const std::vector<char>& in_corner, PlanarMesh& mesh) {
  const int count = static_cast<int>(mesh.vertices.size());
  std::vector<std::array<int, 2>> beside(count, {-1, -1});
  for (const auto& [a, b] : mesh.rim) beside[a][1] = b, beside[b][0] = a;
  const std::vector<int>&first = fans.first, &around = fans.around;
  for (int pass = 0; pass < kSmoothingPasses; ++pass) {
    // The rim first: the inner vertices make room for it.
    for (int n = 0; n < count; ++n) {
      const int v = (n + mesh.inner_count) % count;
      if (in_corner[v]) continue;
      const Eigen::Vector2d old = mesh.vertices[v];
      Eigen::Vector2d target = Eigen::Vector2d::Zero();
      if (v >= mesh.inner_count) {
        const Eigen::Vector2d &a = mesh.vertices[beside[v][0]], &b = mesh.vertices[beside[v][1]];
        const double da = (a - old).norm(), db = (b - old).norm();
        const double move = 0.5 * (da - db);  // along the rim, until both sides are equally long
        target = move > 0 ? Eigen::Vector2d(old + (a - old) * (move / da))
                          : Eigen::Vector2d(old + (b - old) * (-move / db));
      } else {
        for (int k = first[v]; k < first[v + 1]; ++k) {
          for (const int other : mesh.triangles[around[k]]) target += mesh.vertices[other];
        }
        const int triangles = first[v + 1] - first[v];
        target = (target - triangles * old) / (2 * triangles);
      }
      if ((target - old).squaredNorm() < 1e-6 * mesh.cell_px * mesh.cell_px) continue;
      const double before = fans.worst(mesh, v);
      mesh.vertices[v] = target;
      if (fans.worst(mesh, v) <= before) mesh.vertices[v] = old;
    }
  }
}

}  // namespace

PlanarMesh triangulateFigure(const Plane8& mask, const PixelBox& box, std::vector<Polygon> outline,
                             double cell_px) {
  SKEL_CHECK(box.width() > 0 && cell_px > 0);
  std::vector<Eigen::Vector2d> corners;
  for (Polygon& curve : outline) {
    addCorners(curve, cell_px, corners);
    smoothOutline(curve, std::max(2, static_cast<int>(std::lround(0.4 * cell_px))),
                  0.5 * std::max(1.0, cell_px));
  }
  PlanarMesh mesh = Builder(labelGrid(mask, box, outline, cell_px)).build();
  const Fans fans(mesh);
  improve(fans, meetCorners(corners, fans, mesh), mesh);
  return mesh;
}

}  // namespace skel
