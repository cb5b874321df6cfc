#include "libskel/mesh/cut_polygon.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "libskel/core/rng.h"
#include "tests/support/catch.h"

using namespace skel;
using Polygon3 = std::vector<Eigen::Vector3f>;

namespace {

double twiceArea(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
  return (b - a).cross(c - a).cast<double>().z();
}

// Nothing overlaps and nothing is left over: no triangle is turned over, and the areas add up.
void checkCut(const Polygon3& corners) {
  double whole = 0, sum = 0;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    whole += twiceArea(corners[0], corners[k], corners[k + 1]);
  const auto triangles = cutPolygon(corners);
  REQUIRE(triangles.size() == corners.size() - 2);
  for (const auto& [a, b, c] : triangles) {
    const double area = twiceArea(corners[a], corners[b], corners[c]);
    CHECK(area * whole > 0);
    sum += area;
  }
  CHECK(sum == Approx(whole));
}

const Polygon3 kL = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};

Polygon3 star(int points, float inner) {
  Polygon3 result;
  for (int k = 0; k < 2 * points; ++k) {
    const float angle = std::numbers::pi_v<float> * static_cast<float>(k) / static_cast<float>(points);
    const float radius = k % 2 ? inner : 1;
    result.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.f);
  }
  return result;
}

}  // namespace

TEST_CASE("concave polygons are cut from any corner on, either way round") {
  Polygon3 comb = {{10, 0, 0}, {10, 1, 0}};  // its teeth hang from a thin bar
  for (int tooth = 9; tooth >= 0; --tooth) {
    const auto x = static_cast<float>(tooth);
    comb.insert(comb.end(), {{x + 0.9f, 0.9f, 0.f}, {x + 0.5f, -5.f, 0.f}, {x + 0.1f, 0.9f, 0.f}});
  }
  comb.insert(comb.end(), {{0, 1, 0}, {0, 2, 0}, {11, 2, 0}, {11, 0, 0}});
  // Corners in the middle of a side.
  const Polygon3 flat = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0},
                         {2, 2, 0}, {1, 1, 0}, {0, 2, 0}, {0, 1, 0}};
  for (Polygon3 polygon : {kL, star(5, 0.38f), star(5, 0.1f), star(300, 0.5f), comb, flat}) {
    for (std::size_t first = 0; first < std::min<std::size_t>(polygon.size(), 30); ++first) {
      std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
      checkCut(polygon);
      checkCut({polygon.rbegin(), polygon.rend()});
    }
  }
}

TEST_CASE("a cut does not depend on the plane that the polygon lies in") {
  const auto seen = cutPolygon(kL);
  Polygon3 turned = kL;
  for (const Eigen::Vector3f& axis : {Eigen::Vector3f(1, 0, 0), {0, 1, 0}, {1, 2, 3}, {-1, 1, 0}}) {
    for (std::size_t k = 0; k < kL.size(); ++k)
      turned[k] = Eigen::AngleAxisf(2, axis.normalized()) * kL[k] + Eigen::Vector3f(5, 6, 7);
    CHECK(cutPolygon(turned) == seen);
  }
}

TEST_CASE("a convex polygon becomes the fan around its first corner") {
  using Triangles = std::vector<std::array<int, 3>>;
  CHECK(cutPolygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}) == Triangles{{0, 1, 2}});
  CHECK(cutPolygon({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 2, 0}, {0, 1, 0}}) ==
        Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
}

TEST_CASE("random polygons around a point") {
  Rng rng(1);
  for (int trial = 0; trial < 200; ++trial) {
    const int count = 3 + static_cast<int>(rng.below(60));
    Polygon3 polygon;
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * std::numbers::pi * (k + rng.uniform(0, 0.9)) / count;
      const double radius = rng.uniform(0.5, 10);
      polygon.push_back(Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), 0).cast<float>());
    }
    checkCut(polygon);
  }
}

TEST_CASE("polygons that cross themselves or have no area are cut somehow") {
  for (const Polygon3& polygon :
       {Polygon3{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, Polygon3(7, Eigen::Vector3f::Zero()),
        Polygon3{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1, 0, 0}},
        Polygon3{{3e38f, 0, 0}, {-3e38f, 0, 0}, {0, 3e38f, 0}, {0, -3e38f, 1}}}) {
    const auto triangles = cutPolygon(polygon);
    REQUIRE(triangles.size() == polygon.size() - 2);
    for (const auto& triangle : triangles)
      for (const int corner : triangle) CHECK((corner >= 0 && corner < static_cast<int>(polygon.size())));
  }
  // The star as one line draws it.
  Polygon3 pentagram;
  for (const int k : {0, 4, 8, 2, 6}) pentagram.push_back(star(5, 1)[k]);
  CHECK(cutPolygon(pentagram).size() == 3);
}
