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
#include "libskel/mesh/outline_band.h"
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

// The flange that a drawn outline becomes rises from the rim to this share of the outline's width.
constexpr double kFlange = 0.3;

// z of the inner vertices, px. Those within the drawn outline (`band`, its width there, else 0) lie on its
// flange; the body rises behind it.
Eigen::VectorXd inflatedHeights(const PlanarMesh& mesh, const std::vector<double>& band) {
  const int count = mesh.inner_count;
  // Obtuse triangles at the rim could let u touch zero inside.
  const double floor = 0.05 * mesh.cell_px;
  const auto flange = [&](int v) { return std::pow(std::max(kFlange * band[v], floor), 2); };
  const auto free = [&](int v) { return v < count && band[v] == 0; };
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
      if (free(t[k])) source[t[k]] += kSource * double_area / 6;
      if (free(a)) entries.emplace_back(a, a, half_cotangent);
      if (free(b)) entries.emplace_back(b, b, half_cotangent);
      // The solver reads the lower triangle alone.
      if (free(a) && free(b)) entries.emplace_back(std::max(a, b), std::min(a, b), -half_cotangent);
      if (free(a) && b < count && !free(b)) source[a] += half_cotangent * flange(b);
      if (free(b) && a < count && !free(a)) source[b] += half_cotangent * flange(a);
    }
  }
  for (int v = 0; v < count; ++v)
    if (!free(v)) entries.emplace_back(v, v, 1), source[v] = flange(v);
  Eigen::SparseMatrix<double> laplacian(count, count);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(laplacian);
  SKEL_CHECK(solver.info() == Eigen::Success);
  const Eigen::VectorXd u = solver.solve(source);
  return u.unaryExpr([&](double value) { return std::sqrt(std::max(value, floor * floor)); });
}

constexpr int kLeastTexture = 16;  // texels a side

// The back's texture and where the front's points lie in it.
struct BackTexture {
  Image image;
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  // its coordinates of the front's (0, 0)
  Eigen::Vector2d size = Eigen::Vector2d::Ones();    // and how far it is from there to (1, 1)
};

// The limit of a texture of which two must fit side by side into `max_texture_px`.
int halfOf(int max_texture_px, const PixelBox& box) {
  const double long_by_short =
      std::max(box.width(), box.height()) / double(std::min(box.width(), box.height()));
  const double fitting = (0.5 * max_texture_px - 2 * kTextureMargin) * long_by_short + 2 * kTextureMargin;
  return std::max(kLeastTexture, static_cast<int>(std::min(fitting, double(max_texture_px))));
}

BackTexture backTexture(const DrawingTexture& front, const PixelBox& box, const InflateOptions& options) {
  BackTexture back;
  if (!options.back_picture) {
    std::optional<HeadDisc> head = options.head;
    if (head) {
      const Eigen::Vector2d texels(front.image.width, front.image.height);
      head->center = front.uvFromImage(head->center).cwiseProduct(texels);
      head->radius *= front.image.width / front.size_px.x();
    }
    back.image = backColors(front.image, front.figure, head);
    return back;
  }
  // Seen from behind, left is right.
  const BackPicture& picture = *options.back_picture;
  const PixelBox other = figureBox(picture.mask);
  const bool alike = (other.width() < other.height()) == (box.width() < box.height());
  const DrawingTexture texture =
      drawingTexture(picture.image, picture.mask, other,
                     alike ? halfOf(options.max_texture_px, other) : options.max_texture_px / 2);
  const auto behind = [&](const Eigen::Vector2d& uv) {
    const Eigen::Vector2d p = front.corner_px + uv.cwiseProduct(front.size_px);
    const Eigen::Vector2d at((p.x() - box.x0 + 0.5) / box.width(), (p.y() - box.y0 + 0.5) / box.height());
    return texture.uvFromImage(
        {other.x1 - 0.5 - at.x() * other.width(), other.y0 - 0.5 + at.y() * other.height()});
  };
  back.image = texture.image;
  back.corner = behind({0, 0});
  back.size = behind({1, 1}) - back.corner;
  return back;
}

// Front and back in one picture, side by side or one over the other, whichever is the smaller.
void addBack(TriangleMesh& mesh, const BackTexture& back) {
  const Image &a = mesh.texture, &b = back.image;
  const bool beside = a.width + b.width <= a.height + b.height;
  Image both(beside ? a.width + b.width : std::max(a.width, b.width),
             beside ? std::max(a.height, b.height) : a.height + b.height);
  // What neither covers repeats the nearest: no seam of another colour where a picture is shrunk.
  const auto copy = [&](const Image& part, int x0, int y0, int x1, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x)
        std::copy_n(part.pixel(std::min(x - x0, part.width - 1), std::min(y - y0, part.height - 1)), 4,
                    both.pixel(x, y));
  };
  const int split_x = beside ? a.width : 0, split_y = beside ? 0 : a.height;
  copy(a, 0, 0, beside ? a.width : both.width, beside ? both.height : a.height);
  copy(b, split_x, split_y, both.width, both.height);
  const Eigen::RowVector2d size(both.width, both.height);
  const auto place = [&](const Image& part, const Eigen::RowVector2d& corner, const Eigen::RowVector2d& uv) {
    return Eigen::RowVector2d(
        (corner + uv.cwiseProduct(Eigen::RowVector2d(part.width, part.height))).cwiseQuotient(size));
  };
  mesh.back_uv.resize(mesh.uv.rows(), 2);
  for (Eigen::Index v = 0; v < mesh.uv.rows(); ++v) {
    const Eigen::RowVector2d uv = mesh.uv.row(v).cast<double>();
    const Eigen::RowVector2d behind =
        (back.corner.transpose() + uv.cwiseProduct(back.size.transpose())).cwiseMax(0).cwiseMin(1);
    mesh.back_uv.row(v) = place(b, {split_x, split_y}, behind).cast<float>();
    mesh.uv.row(v) = place(a, {0, 0}, uv).cast<float>();
  }
  mesh.first_back = mesh.triangles.rows() / 2;
  mesh.texture = std::move(both);
}

}  // namespace

TriangleMesh inflate(const Image& image, const Silhouette& silhouette, const InflateOptions& options) {
  SKEL_CHECK(silhouette.found());
  SKEL_CHECK_EQ(silhouette.mask.rows(), image.height);
  SKEL_CHECK_EQ(silhouette.mask.cols(), image.width);
  SKEL_CHECK(options.spacing_px >= 0 && options.thickness > 0 && options.max_texture_px >= 2 * kLeastTexture);

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

  std::vector<double> band(planar.inner_count, 0);
  if (options.thin_outline) band = outlineBand(planar, drawnOutline(image, silhouette.mask, outline));

  TriangleMesh mesh;
  mesh.model_from_image.turned_rad = options.turned_rad;
  const auto upright = [&](const Eigen::Vector2d& p) { return mesh.model_from_image.upright(p); };
  Eigen::Vector2d low = upright(planar.vertices.front()), high = low;
  for (const Eigen::Vector2d& p : planar.vertices)
    low = low.cwiseMin(upright(p)), high = high.cwiseMax(upright(p));
  mesh.model_from_image.scale.setConstant(options.length_m > 0 ? options.length_m / (high - low).maxCoeff()
                                                               : options.height_m / (high.y() - low.y()));
  // Turned back into the drawing; exactly what it was where nothing is turned.
  const Eigen::Vector2d soles(0.5 * (low.x() + high.x()), high.y());
  mesh.model_from_image.origin_px =
      options.turned_rad == 0 ? soles : Eigen::Vector2d(Eigen::Rotation2Dd(options.turned_rad) * soles);

  // Bridges show the paper: they take the colours of what they join.
  const Plane8 drawn = silhouette.bridges.size() == 0
                           ? silhouette.mask
                           : Plane8((silhouette.bridges != 0)
                                        .select(Plane8::Zero(silhouette.mask.rows(), silhouette.mask.cols()),
                                                silhouette.mask));
  const bool same_back = options.back == Back::kSame && !options.back_picture;
  const DrawingTexture texture = drawingTexture(
      image, drawn, box, same_back ? options.max_texture_px : halfOf(options.max_texture_px, box));
  mesh.texture = texture.image;
  const Eigen::VectorXd z =
      inflatedHeights(planar, band) * (options.thickness * mesh.model_from_image.scale.y());

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
  if (!same_back) addBack(mesh, backTexture(texture, box, options));
  return mesh;
}

}  // namespace skel
