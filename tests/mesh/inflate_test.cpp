#include "libskel/mesh/inflate.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "libskel/core/error.h"
#include "libskel/core/rng.h"
#include "libskel/image/read_image.h"
#include "libskel/mesh/outline.h"
#include "libskel/mesh/planar_mesh.h"
#include "tests/support/catch.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/random_silhouette.h"
#include "tests/support/synthetic_figure.h"

using namespace skel;

namespace {

Image paint(const Plane8& mask) {
  Image image(static_cast<int>(mask.cols()), static_cast<int>(mask.rows()));
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t value = mask(y, x) ? 40 : 250;
      std::fill_n(image.pixel(x, y), 3, value);
      image.pixel(x, y)[3] = 255;
    }
  }
  return image;
}

TriangleMesh inflateMask(const Plane8& mask, const InflateOptions& options = {}) {
  const Silhouette silhouette = silhouetteFromMask(mask);
  INFO(silhouette.reason);
  REQUIRE(silhouette.found());
  return inflate(paint(mask), silhouette, options);
}

Plane8 disc(int size, double radius) {
  Plane8 mask = Plane8::Zero(size, size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      if (std::hypot(x - 0.5 * (size - 1), y - 0.5 * (size - 1)) <= radius) mask(y, x) = 255;
    }
  }
  return mask;
}

// Signed by side: how far the mesh's outline strays from the mask's, image px. Every pixel that the mesh
// covers wrongly, or fails to cover, is looked up in the mask.
double outlineError(const TriangleMesh& mesh, const Plane8& mask) {
  const int w = static_cast<int>(mask.cols()), h = static_cast<int>(mask.rows());
  Plane8 covered = Plane8::Zero(h, w);
  for (Eigen::Index t = 0; t < mesh.triangles.rows() / 2; ++t) {
    Eigen::Vector2d p[3];
    for (int k = 0; k < 3; ++k) {
      p[k] = mesh.model_from_image.inverse(
          mesh.vertices.row(mesh.triangles(t, k)).head<2>().transpose().cast<double>());
    }
    const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b, double x, double y) {
      return (b.x() - a.x()) * (y - a.y()) - (x - a.x()) * (b.y() - a.y());
    };
    const auto low = p[0].cwiseMin(p[1]).cwiseMin(p[2]).eval(),
               high = p[0].cwiseMax(p[1]).cwiseMax(p[2]).eval();
    for (int y = std::max(0, int(std::ceil(low.y()))); y <= std::min(h - 1, int(std::floor(high.y()))); ++y) {
      for (int x = std::max(0, int(std::ceil(low.x()))); x <= std::min(w - 1, int(std::floor(high.x())));
           ++x) {
        const double a = cross(p[0], p[1], x, y), b = cross(p[1], p[2], x, y), c = cross(p[2], p[0], x, y);
        if ((a <= 1e-9 && b <= 1e-9 && c <= 1e-9) || (a >= -1e-9 && b >= -1e-9 && c >= -1e-9))
          covered(y, x) = 255;
      }
    }
  }
  double worst = 0;
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const bool in = mask(y, x) != 0;
      if (in == (covered(y, x) != 0)) continue;
      // To the nearest pixel of the other side: the outline runs half a px before its centre.
      double nearest = HUGE_VAL;
      for (int reach = 1; reach < std::max(w, h) && nearest > reach; ++reach) {
        for (int v = y - reach; v <= y + reach; ++v) {
          for (int u = x - reach; u <= x + reach; ++u) {
            if (std::max(std::abs(u - x), std::abs(v - y)) != reach) continue;
            const bool other = v >= 0 && u >= 0 && v < h && u < w && mask(v, u) != 0;
            if (other != in) nearest = std::min(nearest, std::hypot(u - x, v - y));
          }
        }
      }
      worst = std::max(worst, nearest - 0.5);
    }
  }
  return worst;
}

// Closed parts' Euler number: two for the outer contour, less two for each hole.
int expectedEuler(const Silhouette& silhouette) {
  return 4 - 2 * static_cast<int>(silhouette.outline.size());
}

}  // namespace

TEST_CASE("a disc becomes a body about as thick as wide, in the model's frame") {
  const TriangleMesh mesh = inflateMask(disc(301, 140));
  const MeshReport report = checkMesh(mesh);
  CHECK(report.problem == "");
  CHECK(report.parts == 1);
  CHECK(report.euler == 2);
  CHECK(mesh.vertices.rows() > 2000);
  CHECK(mesh.vertices.rows() < 5000);
  const Eigen::RowVector3f low = mesh.vertices.colwise().minCoeff(),
                           high = mesh.vertices.colwise().maxCoeff();
  CHECK(low.y() == Approx(0).margin(1e-6));
  CHECK(high.y() == Approx(kModelHeight_m));
  CHECK(high.x() == Approx(-low.x()));
  CHECK(high.z() == Approx(-low.z()));
  CHECK(2 * high.z() == Approx(0.79 * kModelHeight_m).epsilon(0.03));
  CHECK(mesh.model_from_image(Eigen::Vector2d(150, 150)).norm() == Approx(kModelHeight_m / 2).epsilon(0.01));
}

TEST_CASE("a long strip becomes about as thick as wide") {
  Plane8 mask = Plane8::Zero(420, 100);
  mask.block(10, 30, 400, 40).setConstant(255);
  const TriangleMesh mesh = inflateMask(mask);
  const Eigen::RowVector3f size = mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff();
  CHECK(size.z() / size.x() == Approx(1.12).epsilon(0.03));
  InflateOptions half;
  half.thickness = 0.5;
  const TriangleMesh thin = inflateMask(mask, half);
  CHECK(thin.vertices.col(2).maxCoeff() == Approx(0.5 * mesh.vertices.col(2).maxCoeff()));
}

TEST_CASE("random silhouettes become closed manifolds with the figure's outline and holes") {
  Rng rng(7);
  int made = 0;
  for (int n = 0; n < 2500; ++n) {
    const Plane8 mask = randomSilhouette(rng, n % 10 == 0 ? 160 : 48);
    Silhouette silhouette = silhouetteFromMask(mask);
    if (!silhouette.found()) continue;
    ++made;
    InflateOptions options;
    // Cells from a third of a px to several px.
    const int longer = std::max(figureBox(silhouette.mask).width(), figureBox(silhouette.mask).height());
    const double cell_px = std::exp(rng.uniform(std::log(0.5), std::log(6)));
    options.spacing_px = cell_px * kWorkingGridSize / longer;
    const TriangleMesh mesh = inflate(paint(mask), silhouette, options);
    const MeshReport report = checkMesh(mesh);
    INFO("silhouette " << n << ", cell " << cell_px << " px");
    REQUIRE(report.problem == "");
    REQUIRE(report.parts == 1);
    if (cell_px <= 1) REQUIRE(report.euler == expectedEuler(silhouette));
    REQUIRE(outlineError(mesh, silhouette.mask) <= std::max(1.0, cell_px));
  }
  CHECK(made > 1500);
}

TEST_CASE("the default cell gives 2,000 to 5,000 vertices whatever the shape") {
  Rng rng(11);
  for (int n = 0; n < 150; ++n) {
    const Plane8 mask = randomSilhouette(rng, 200);
    const Silhouette silhouette = silhouetteFromMask(mask);
    if (!silhouette.found()) continue;
    const TriangleMesh mesh = inflate(paint(mask), silhouette);
    INFO("silhouette " << n);
    REQUIRE(checkMesh(mesh).problem == "");
    REQUIRE(mesh.vertices.rows() >= 2000);
    REQUIRE(mesh.vertices.rows() <= 5000);
  }
}

TEST_CASE("degenerate figures") {
  const auto [rows, columns] =
      GENERATE(table<int, int>({{1, 1}, {1, 40}, {40, 1}, {2, 2}, {64, 64}, {3, 200}}));
  Plane8 mask = Plane8::Constant(rows, columns, 255);
  Silhouette silhouette;
  silhouette.status = SilhouetteStatus::kFound;  // whatever the silhouette room thinks of so small a figure
  silhouette.mask = mask;
  silhouette.outline = {
      {{-0.5, -0.5}, {columns - 0.5, -0.5}, {columns - 0.5, rows - 0.5}, {-0.5, rows - 0.5}}};
  for (const double spacing : {0.0, 1.0, 20.0, 500.0}) {
    InflateOptions options;
    options.spacing_px = spacing;
    const MeshReport report = checkMesh(inflate(paint(mask), silhouette, options));
    INFO(rows << " x " << columns << ", spacing " << spacing);
    CHECK(report.problem == "");
    CHECK(report.euler == 2);
  }
}

TEST_CASE("a gap narrower than a cell stays open, a hairline stays a tube") {
  // An arm two px beside a trunk, joined at the top; a leg one px wide.
  Plane8 mask = Plane8::Zero(300, 200);
  mask.block(20, 40, 180, 60).setConstant(255);
  mask.block(20, 102, 120, 20).setConstant(255);
  mask.block(20, 100, 20, 2).setConstant(255);
  mask.block(200, 60, 90, 1).setConstant(255);
  InflateOptions options;
  options.spacing_px = 2.5;  // 5.3 px
  const TriangleMesh mesh = inflateMask(mask, options);
  CHECK(checkMesh(mesh).problem == "");
  // Nothing of the gap is covered well below its top.
  int across = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    double left = HUGE_VAL, right = -HUGE_VAL, top = HUGE_VAL;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d p = mesh.model_from_image.inverse(
          mesh.vertices.row(mesh.triangles(t, k)).head<2>().transpose().cast<double>());
      left = std::min(left, p.x()), right = std::max(right, p.x()), top = std::min(top, p.y());
    }
    if (left < 97 && right > 105 && top > 50) ++across;
  }
  CHECK(across == 0);
  const Eigen::Vector2d toe = mesh.model_from_image.inverse({0, 0});
  CHECK(toe.y() == Approx(289.5).margin(5.3));
}

TEST_CASE("only the figure's colours are in the texture, from the outline outwards too") {
  const CapsuleFigure figure;
  const Plane8 mask = capsuleMask(figure);
  const TriangleMesh mesh = inflate(capsuleImage(figure), silhouetteFromMask(mask));
  CHECK((mesh.texture.rgba.col(0) == 60).all());
  CHECK((mesh.texture.rgba.col(2) == 160).all());
  CHECK((mesh.texture.rgba.col(3) == 255).all());
  CHECK(mesh.uv.minCoeff() >= 0);
  CHECK(mesh.uv.maxCoeff() <= 1);

  // Transparent paper, whatever colour hides under it, and a limit.
  Image clear = capsuleImage(figure);
  for (int i = 0; i < clear.rgba.rows(); ++i) {
    if (clear.rgba(i, 0) == 255) clear.rgba.row(i) << 0, 255, 0, 0;
  }
  InflateOptions options;
  options.max_texture_px = 64;
  const TriangleMesh small = inflate(clear, silhouetteFromMask(mask), options);
  CHECK(std::max(small.texture.width, small.texture.height) <= 64);
  CHECK((small.texture.rgba.col(1) == 80).all());
  CHECK((small.uv - mesh.uv).cwiseAbs().maxCoeff() < 0.08f);
}

TEST_CASE("too fine a spacing is refused with the one that would do") {
  InflateOptions options;
  options.spacing_px = 1e-3;
  try {
    inflateMask(disc(100, 40), options);
    FAIL("no error");
  } catch (const UsageError& error) {
    CHECK(std::string(error.what())
              .find("mesh spacing of 0.001 px would give more than 1000000 vertices; use 0.") !=
          std::string::npos);
  }
}

TEST_CASE("every real drawing becomes a closed manifold") {
  const char* root = std::getenv("SKEL_EVAL_DIR");
  if (!root) {
    std::cout << "SKIPPED: SKEL_EVAL_DIR is not set\n";
    return;
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(std::string(root) + "/characters")) {
    if (entry.path().filename() != "mask.png") continue;
    INFO(entry.path().string());
    const Image image = readImage((entry.path().parent_path() / "image.png").string());
    const Silhouette silhouette = silhouetteFromMask(readMask(entry.path().string()));
    REQUIRE(silhouette.found());
    const TriangleMesh mesh = inflate(image, silhouette);
    const MeshReport report = checkMesh(mesh);
    CHECK(report.problem == "");
    CHECK(report.parts == 1);
    CHECK(mesh.vertices.rows() >= 2000);
    CHECK(mesh.vertices.rows() <= 5000);
    const double cell_px =
        std::sqrt(2.0 * (silhouette.mask != 0).count() / static_cast<double>(mesh.vertices.rows()));
    CHECK(outlineError(mesh, silhouette.mask) <= std::max(1.0, cell_px));
  }
}

TEST_CASE("the mesh does not depend on the order in which a compiler evaluates arguments") {
  // A figure of one node: four cells with this corner alone, each of which makes its crossings in the order
  // that GCC chose when it was free to choose.
  Plane8 mask = Plane8::Zero(5, 5);
  mask(2, 2) = 255;
  PixelBox box;
  box.x0 = box.y0 = 2, box.x1 = box.y1 = 3;
  const PlanarMesh mesh = triangulateFigure(mask, box, {{{2, 1.5}, {2.5, 2}, {2, 2.5}, {1.5, 2}}}, 1);
  REQUIRE(mesh.inner_count == 1);
  const std::vector<std::array<int, 3>> expected = {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {0, 4, 3}};
  CHECK(mesh.triangles == expected);
}

TEST_CASE("where an outline turns sharply, the mesh does") {
  Plane8 mask = Plane8::Zero(200, 200);
  for (int y = 0; y < 150; ++y)
    mask.block(20 + y, 30 + y / 3, 1, 140 - 2 * (y / 3)) = 255;  // a tapering foot
  const Silhouette silhouette = silhouetteFromMask(mask);
  std::vector<Polygon> outline;
  for (const Polygon& curve : silhouette.outline) outline.push_back(sideMiddles(curve));
  int met = 0, all = 0;
  for (double cell_px = 5; cell_px < 14; cell_px += 0.7) {
    const PlanarMesh mesh = triangulateFigure(mask, figureBox(mask), outline, cell_px);
    for (const Eigen::Vector2d& corner : {Eigen::Vector2d(30, 20), {170, 20}, {79, 170}, {121, 170}}) {
      double least = 1e9;
      for (std::size_t v = std::size_t(mesh.inner_count); v < mesh.vertices.size(); ++v)
        least = std::min(least, (mesh.vertices[v] - corner).norm());
      met += least < 2;
      all += 1;
    }
  }
  // Not where a triangle would be too thin.
  CHECK(met > 0.9 * all);
}
