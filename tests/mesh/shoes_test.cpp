#include "libskel/mesh/shoes.h"

#include <algorithm>

#include "libskel/mesh/planar_mesh.h"
#include "tests/support/catch.h"

using namespace skel;

// Notches stood in it where no vertex of the rim lay below one inside.
TEST_CASE("a sole that is drawn straight is straight, wherever the grid's lines lie") {
  const auto ground = [](double x) { return 160 + 0.2 * (x - 100); };
  Plane8 mask = Plane8::Zero(200, 200);
  mask.block(20, 90, 120, 20) = 255;  // a shin
  for (int x = 55; x < 145; ++x) mask.block(130, x, int(ground(x + 0.5)) - 130, 1) = 255;
  const Silhouette silhouette = silhouetteFromMask(mask);
  std::vector<Polygon> outline;
  for (const Polygon& curve : silhouette.outline) outline.push_back(sideMiddles(curve));
  int came_down = 0;
  for (double cell_px = 5; cell_px < 12; cell_px += 0.5) {
    CAPTURE(cell_px);
    const PlanarMesh mesh = triangulateFigure(mask, figureBox(mask), outline, cell_px);
    const std::vector<double> bare(mesh.vertices.size(), 0);
    OutlineBand band{bare, std::vector<bool>(bare.size(), false), mesh.vertices, mesh.vertices};
    Heights heights{Eigen::VectorXd::Zero(mesh.inner_count), Eigen::VectorXd::Zero(mesh.inner_count)};
    std::vector<Eigen::Vector2d> place = mesh.vertices;
    putOnShoes(mesh, {{.knee = {100, 40}, .foot = {100, 140}, .radius_px = 20}}, bare, band, heights, place);
    for (int v = 0; v < mesh.inner_count; ++v) {
      const Eigen::Vector2d& p = mesh.vertices[v];
      const double above = ground(p.x()) - p.y();
      if (above > cell_px || std::abs(p.x() - 100) > 35) continue;
      CHECK(ground(p.x()) - place[v].y() < 0.1 * above + std::max(1., 0.15 * cell_px) + 0.2);
      came_down += 1;
    }
  }
  CHECK(came_down > 50);
}

// It was streaked with both, as vertices lay within the line and beyond it by turns.
TEST_CASE("a sole with a drawn outline wears what lies past that, nowhere the line's colour") {
  constexpr double kLine = 6;
  Plane8 mask = Plane8::Zero(200, 200);
  mask.block(20, 90, 120, 20) = 255;  // a shin
  mask.block(130, 55, 30, 90) = 255;  // a foot
  const Silhouette silhouette = silhouetteFromMask(mask);
  std::vector<Polygon> outline;
  for (const Polygon& curve : silhouette.outline) outline.push_back(sideMiddles(curve));
  const PlanarMesh mesh = triangulateFigure(mask, figureBox(mask), outline, 5);
  OutlineBand band{std::vector<double>(std::size_t(mesh.inner_count), 0),
                   std::vector<bool>(std::size_t(mesh.inner_count), false), mesh.vertices, mesh.vertices};
  for (int v = 0; v < mesh.inner_count; ++v)
    if (160 - mesh.vertices[v].y() < kLine) band.width_px[v] = kLine;
  const std::vector<double> bare(std::size_t(mesh.inner_count), 0);
  Heights heights{Eigen::VectorXd::Zero(mesh.inner_count), Eigen::VectorXd::Zero(mesh.inner_count)};
  std::vector<Eigen::Vector2d> place = mesh.vertices;
  putOnShoes(mesh, {{.knee = {100, 40}, .foot = {100, 140}, .radius_px = 20}}, bare, band, heights, place);
  int seen = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Eigen::Vector2d& p = mesh.vertices[v];
    if (160 - p.y() > kLine || std::abs(p.x() - 100) > 35) continue;
    CAPTURE(p.transpose());
    CHECK(160 - band.drawn[v].y() > kLine);
    CHECK(160 - place[v].y() < 2);
    seen += 1;
  }
  CHECK(seen > 20);

  // The white of a sole is its own.
  band.light.assign(band.light.size(), true);
  band.drawn = mesh.vertices;
  putOnShoes(mesh, {{.knee = {100, 40}, .foot = {100, 140}, .radius_px = 20}}, bare, band, heights, place);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) CHECK(band.drawn[v] == mesh.vertices[v]);
}
