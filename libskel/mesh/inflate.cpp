// L. Feng, X. Yang, S. Xiao, "MagicToon: A 2D-to-3D creative cartoon modeling system with mobile AR" (2017),
// section on inflation. The Poisson equation is solved by linear finite elements on the mesh itself
// (cotangent weights: U. Pinkall, K. Polthier, "Computing discrete minimal surfaces and their conjugates",
// 1993).
#include "libskel/mesh/inflate.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/mesh/outline.h"
#include "libskel/mesh/planar_mesh.h"
#include "libskel/mesh/texture.h"

namespace skel {
namespace {

constexpr double kVertexCount = 3500;

// −Δu of the Poisson equation. A long strip of width w gets z² = c/2·(w²/4 − x²), as thick as wide for c = 2;
// a disc of diameter d gets z² = c/4·(d²/4 − r²), a ball for c = 4. Limbs end, and so are a little thinner
// than a long strip: 2.5 makes drawn limbs round and heads and bodies four fifths as thick as wide.
constexpr double kSource = 2.5;

// Two sheets share the rim: A / cell² nodes twice, and the rim's crossings with the grid's lines, 4/π·L /
// cell of them for an outline of length L in no special direction.
struct VertexEstimate {
  double twice_area_px2 = 0, crossings_px = 0;

  double count(double cell_px) const { return (twice_area_px2 / cell_px + crossings_px) / cell_px; }
  double cell(double count) const {
    return (crossings_px + std::sqrt(crossings_px * crossings_px + 4 * twice_area_px2 * count)) / (2 * count);
  }
};

VertexEstimate estimateVertices(const std::vector<Polygon>& outline) {
  VertexEstimate result;
  for (const Polygon& curve : outline) {
    Eigen::Vector2d p = curve.back();
    for (const Eigen::Vector2d& q : curve) {
      result.twice_area_px2 += p.x() * q.y() - q.x() * p.y();
      result.crossings_px += 4 / 3.14159265358979 * (q - p).norm();
      p = q;
    }
  }
  return result;
}

// z of the inner vertices, px.
Eigen::VectorXd inflatedHeights(const PlanarMesh& mesh) {
  const int count = mesh.inner_count;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * mesh.triangles.size());
  Eigen::VectorXd source = Eigen::VectorXd::Zero(count);
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector2d p[3] = {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    const Eigen::Vector2d e = p[1] - p[0], f = p[2] - p[0];
    const double double_area = std::abs(e.x() * f.y() - e.y() * f.x());
    for (int k = 0; k < 3; ++k) {
      const int a = t[(k + 1) % 3], b = t[(k + 2) % 3];
      const double half_cotangent = 0.5 * (p[(k + 1) % 3] - p[k]).dot(p[(k + 2) % 3] - p[k]) / double_area;
      if (t[k] < count) source[t[k]] += kSource * double_area / 6;
      if (a < count) entries.emplace_back(a, a, half_cotangent);
      if (b < count) entries.emplace_back(b, b, half_cotangent);
      // The solver reads the lower triangle alone.
      if (a < count && b < count) entries.emplace_back(std::max(a, b), std::min(a, b), -half_cotangent);
    }
  }
  Eigen::SparseMatrix<double> laplacian(count, count);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(laplacian);
  SKEL_CHECK(solver.info() == Eigen::Success);
  const Eigen::VectorXd u = solver.solve(source);
  // Obtuse triangles at the rim could let u touch zero inside.
  const double floor = 0.05 * mesh.cell_px;
  return u.unaryExpr([&](double value) { return std::sqrt(std::max(value, floor * floor)); });
}

}  // namespace

TriangleMesh inflate(const Image& image, const Silhouette& silhouette, const InflateOptions& options) {
  SKEL_CHECK(silhouette.found());
  SKEL_CHECK_EQ(silhouette.mask.rows(), image.height);
  SKEL_CHECK_EQ(silhouette.mask.cols(), image.width);
  SKEL_CHECK(options.spacing_px >= 0 && options.thickness > 0 && options.max_texture_px >= 16);

  const PixelBox box = figureBox(silhouette.mask);
  SKEL_CHECK(box.width() > 0);
  std::vector<Polygon> outline;
  for (const Polygon& corners : silhouette.outline) outline.push_back(sideMiddles(corners));
  const VertexEstimate estimate = estimateVertices(outline);
  const double px_per_grid_px = std::max(box.width(), box.height()) / double(kWorkingGridSize);
  double cell_px = options.spacing_px * px_per_grid_px;
  if (cell_px == 0) cell_px = estimate.cell(kVertexCount);
  if (estimate.count(cell_px) > kMaxInflatedVertices) {
    std::ostringstream message;
    message << "a mesh spacing of " << options.spacing_px << " px would give more than "
            << kMaxInflatedVertices << " vertices; use "
            << estimate.cell(kMaxInflatedVertices) / px_per_grid_px << " or more";
    throw UsageError(message.str());
  }
  PlanarMesh planar = triangulateFigure(silhouette.mask, box, outline, cell_px);
  // A figure full of holes smaller than a cell loses them, and with them vertices that were counted on.
  for (int attempt = 0; attempt < 4 && options.spacing_px == 0; ++attempt) {
    const double count = 2.0 * planar.inner_count + static_cast<double>(planar.rim.size());
    if (count > 0.7 * kVertexCount && count < 1.3 * kVertexCount) break;
    cell_px *= std::sqrt(count / kVertexCount);
    planar = triangulateFigure(silhouette.mask, box, outline, cell_px);
  }

  Eigen::Vector2d low = planar.vertices.front(), high = low;
  for (const Eigen::Vector2d& p : planar.vertices) low = low.cwiseMin(p), high = high.cwiseMax(p);
  TriangleMesh mesh;
  mesh.model_from_image.scale.setConstant(kModelHeight_m / (high.y() - low.y()));
  mesh.model_from_image.origin_px = {0.5 * (low.x() + high.x()), high.y()};

  // Bridges show the paper: they take the colours of what they join.
  const Plane8 drawn = silhouette.bridges.size() == 0
                           ? silhouette.mask
                           : Plane8((silhouette.bridges != 0)
                                        .select(Plane8::Zero(silhouette.mask.rows(), silhouette.mask.cols()),
                                                silhouette.mask));
  const DrawingTexture texture = drawingTexture(image, drawn, box, options.max_texture_px);
  mesh.texture = texture.image;
  const Eigen::VectorXd z = inflatedHeights(planar) * (options.thickness * mesh.model_from_image.scale.y());

  // The front's inner vertices, the rim, the back's inner vertices.
  const int inner = planar.inner_count, sheet = static_cast<int>(planar.vertices.size());
  mesh.vertices.resize(sheet + inner, 3);
  mesh.uv.resize(sheet + inner, 2);
  for (int v = 0; v < sheet; ++v) {
    const Eigen::Vector2d p = mesh.model_from_image(planar.vertices[v]);
    mesh.vertices.row(v) << p.cast<float>().transpose(), v < inner ? static_cast<float>(z[v]) : 0.0f;
    mesh.uv.row(v) = texture.uvFromImage(planar.vertices[v]).cast<float>();
  }
  mesh.vertices.bottomRows(inner) = mesh.vertices.topRows(inner);
  mesh.vertices.col(2).tail(inner) *= -1;
  mesh.uv.bottomRows(inner) = mesh.uv.topRows(inner);
  const int triangles = static_cast<int>(planar.triangles.size());
  mesh.triangles.resize(2 * triangles, 3);
  const auto behind = [&](int v) { return v < inner ? v + sheet : v; };
  for (int t = 0; t < triangles; ++t) {
    const auto& [a, b, c] = planar.triangles[t];
    mesh.triangles.row(t) << a, b, c;
    mesh.triangles.row(triangles + t) << behind(a), behind(c), behind(b);
  }
  return mesh;
}

}  // namespace skel
