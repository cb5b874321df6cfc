// Edges of the mesh along a line, and what wears a drawn outline.
#include "libskel/mesh/cut_mesh.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "libskel/core/rng.h"
#include "libskel/mesh/inflate.h"
#include "libskel/mesh/outline.h"
#include "tests/support/catch.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/random_silhouette.h"
#include "tests/support/synthetic_figure.h"

using namespace skel;

namespace {

double doubleArea(const PlanarMesh& mesh, const std::array<int, 3>& t) {
  const Eigen::Vector2d e = mesh.vertices[t[1]] - mesh.vertices[t[0]],
                        f = mesh.vertices[t[2]] - mesh.vertices[t[0]];
  return f.x() * e.y() - f.y() * e.x();
}

double wholeArea(const PlanarMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) sum += doubleArea(mesh, t);
  return sum;
}

}  // namespace

TEST_CASE("a mesh is cut where a level is zero: no triangle lies on both sides, nothing is lost") {
  const Plane8 mask = capsuleMask();
  std::vector<Polygon> outline;
  for (const Polygon& corners : silhouetteFromMask(mask).outline) outline.push_back(sideMiddles(corners));
  PlanarMesh mesh = triangulateFigure(mask, figureBox(mask), outline, 9);
  const PlanarMesh before = mesh;
  const auto levelAt = [](const Eigen::Vector2d& p) {
    return 2 * std::sin(0.11 * p.x()) + std::cos(0.07 * p.y());
  };
  std::vector<double> level;
  for (const Eigen::Vector2d& p : mesh.vertices) level.push_back(levelAt(p));
  for (const auto& [a, b] : mesh.rim) level[std::size_t(a)] = level[std::size_t(b)] = -1;
  const std::vector<CutVertex> cuts = cutMesh(mesh, level);
  REQUIRE(cuts.size() > 100);
  const int added = int(cuts.size());
  REQUIRE(mesh.inner_count == before.inner_count + added);
  REQUIRE(mesh.rim.size() == before.rim.size());
  CHECK(wholeArea(mesh) == Approx(wholeArea(before)));
  level.insert(level.begin() + before.inner_count, cuts.size(), 0.0);
  for (const auto& t : mesh.triangles) {
    REQUIRE(doubleArea(mesh, t) > 0);
    REQUIRE(*std::min_element(t.begin(), t.end()) < mesh.inner_count);
    const auto has = [&](int sign) {
      return std::any_of(t.begin(), t.end(), [&](int v) { return level[std::size_t(v)] * sign > 0; });
    };
    REQUIRE_FALSE((has(-1) && has(1)));
  }
  for (int k = 0; k < added; ++k) {
    const CutVertex& cut = cuts[std::size_t(k)];
    REQUIRE(level[std::size_t(cut.a)] < 0);
    REQUIRE(level[std::size_t(cut.b)] > 0);
    const Eigen::Vector2d on = (1 - cut.t) * mesh.vertices[cut.a] + cut.t * mesh.vertices[cut.b];
    REQUIRE((mesh.vertices[before.inner_count + k] - on).norm() < 1e-9);
  }
  for (std::size_t k = 0; k < mesh.rim.size(); ++k)
    REQUIRE(mesh.vertices[mesh.rim[k].first] == before.vertices[before.rim[k].first]);
}

TEST_CASE("a level that is nowhere crossed cuts nothing") {
  const Plane8 mask = Plane8::Constant(40, 40, 255);
  PlanarMesh mesh = triangulateFigure(mask, figureBox(mask), {}, 5);
  const PlanarMesh before = mesh;
  CHECK(cutMesh(mesh, std::vector<double>(mesh.vertices.size(), -1)).empty());
  CHECK(mesh.triangles == before.triangles);
}

TEST_CASE("random silhouettes in lines of any width become closed manifolds") {
  Rng rng(23);
  int made = 0;
  for (int n = 0; n < 400; ++n) {
    const Plane8 mask = randomSilhouette(rng, n % 4 == 0 ? 200 : 64);
    const Silhouette silhouette = silhouetteFromMask(mask);
    if (!silhouette.found()) continue;
    ++made;
    const int width = 1 + int(rng.below(6));
    Image image(int(mask.cols()), int(mask.rows()));
    image.rgba.setConstant(255);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        if (!silhouette.mask(y, x)) continue;
        bool inside = true;
        for (const auto& [dx, dy] : {std::pair{width, 0}, {-width, 0}, {0, width}, {0, -width}}) {
          const int u = x + dx, v = y + dy;
          inside &= u >= 0 && v >= 0 && u < image.width && v < image.height && silhouette.mask(v, u);
        }
        std::fill_n(image.pixel(x, y), 3, std::uint8_t(inside ? 210 : 20));
      }
    InflateOptions options;
    options.thin_outline = true;
    options.back = n % 2 == 0 ? Back::kPlain : Back::kSame;
    options.spacing_px = rng.uniform(0.7, 4);
    INFO("silhouette " << n << ", lines " << width << " px wide");
    const MeshReport report = checkMesh(inflate(image, silhouette, options));
    REQUIRE(report.problem == "");
    REQUIRE(report.parts == 1);
  }
  CHECK(made > 200);
}
