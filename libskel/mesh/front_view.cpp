#include "libskel/mesh/front_view.h"

#include <algorithm>
#include <cmath>

#include "libskel/core/check.h"
#include "libskel/mesh/outline.h"

namespace skel {
namespace {

constexpr int kBorder = 2;

}  // namespace

FrontView frontSilhouette(const TriangleMesh& mesh, int size_px) {
  SKEL_CHECK(mesh.triangles.rows() > 0 && size_px > 0);
  const Eigen::Vector2d low = mesh.vertices.leftCols<2>().colwise().minCoeff().cast<double>();
  const Eigen::Vector2d high = mesh.vertices.leftCols<2>().colwise().maxCoeff().cast<double>();
  const Eigen::Vector2d size = high - low;
  SKEL_CHECK(size.maxCoeff() > 0);
  const double px_per_m = size_px / size.maxCoeff();
  const int width = std::max(1, static_cast<int>(std::ceil(size.x() * px_per_m)));
  const int height = std::max(1, static_cast<int>(std::ceil(size.y() * px_per_m)));

  FrontView view;
  view.model_from_image.scale.setConstant(1 / px_per_m);
  // Pixel borders, not centres, lie on the model's bounding box.
  view.model_from_image.origin_px = {kBorder - 0.5 - low.x() * px_per_m, kBorder - 0.5 + high.y() * px_per_m};
  view.mask = Plane8::Zero(height + 2 * kBorder, width + 2 * kBorder);
  const auto set = [&](const Eigen::Vector2d& p) {
    const int x = std::clamp(static_cast<int>(std::floor(p.x() + 0.5)), kBorder, kBorder + width - 1);
    const int y = std::clamp(static_cast<int>(std::floor(p.y() + 0.5)), kBorder, kBorder + height - 1);
    view.mask(y, x) = 255;
  };
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    Eigen::Vector2d p[3];
    for (int k = 0; k < 3; ++k) {
      p[k] = view.model_from_image.inverse(
          mesh.vertices.row(mesh.triangles(t, k)).head<2>().transpose().cast<double>());
    }
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d side = p[(k + 1) % 3] - p[k];
      const int steps = static_cast<int>(std::ceil(2 * side.lpNorm<Eigen::Infinity>())) + 1;
      for (int s = 0; s <= steps; ++s) set(p[k] + side * (static_cast<double>(s) / steps));
    }
    // Pixel centres inside, row by row.
    const double top = std::min({p[0].y(), p[1].y(), p[2].y()}),
                 bottom = std::max({p[0].y(), p[1].y(), p[2].y()});
    for (int y = static_cast<int>(std::ceil(top)); y <= static_cast<int>(std::floor(bottom)); ++y) {
      double left = HUGE_VAL, right = -HUGE_VAL;
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector2d &a = p[k], &b = p[(k + 1) % 3];
        if ((a.y() < y) == (b.y() < y) && a.y() != y && b.y() != y) continue;
        const double x = a.y() == b.y() ? a.x() : a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y());
        left = std::min(left, x), right = std::max(right, x);
      }
      for (int x = static_cast<int>(std::ceil(left)); x <= static_cast<int>(std::floor(right)); ++x)
        set({x, y});
    }
  }
  return view;
}

ModelFromImage bindByBoundingBox(const Plane8& mask, const TriangleMesh& mesh) {
  const PixelBox box = figureBox(mask);
  SKEL_CHECK(box.width() > 0 && mesh.vertices.rows() > 0);
  const Eigen::Vector2d low = mesh.vertices.leftCols<2>().colwise().minCoeff().cast<double>();
  const Eigen::Vector2d high = mesh.vertices.leftCols<2>().colwise().maxCoeff().cast<double>();
  const Eigen::Vector2d size = (high - low).cwiseMax(1e-9 * (high - low).maxCoeff());
  ModelFromImage result;
  result.scale = size.cwiseQuotient(Eigen::Vector2d(box.width(), box.height()));
  result.origin_px = {box.x0 - 0.5 - low.x() / result.scale.x(), box.y0 - 0.5 + high.y() / result.scale.y()};
  return result;
}

void standUpright(TriangleMesh& mesh) {
  SKEL_CHECK(mesh.vertices.rows() > 0);
  // In double: a model may have any unit.
  const Eigen::MatrixX3d vertices = mesh.vertices.cast<double>();
  const Eigen::RowVector3d low = vertices.colwise().minCoeff(), high = vertices.colwise().maxCoeff();
  SKEL_CHECK(high.y() > low.y());
  const Eigen::RowVector3d soles(0.5 * (low.x() + high.x()), low.y(), 0.5 * (low.z() + high.z()));
  mesh.vertices = ((vertices.rowwise() - soles) * (kModelHeight_m / (high.y() - low.y()))).cast<float>();
}

}  // namespace skel
