// Diffusion: in each step a triangle takes the mean of its corners, then a corner that of its triangles, by
// area (G. Taubin, "A signal processing approach to fair surface design", 1995, section 2).
#include "libskel/mesh/local_mean.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace skel {
namespace {

constexpr double kStepReach = 0.63;  // cells that a step reaches, root mean square, each way
constexpr int kMostSteps = 200;

}  // namespace

Eigen::VectorXd localMean(const PlanarMesh& mesh, const Eigen::VectorXd& values, double range_px) {
  const auto size = static_cast<Eigen::Index>(mesh.vertices.size());
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(size), area = mean;
  mean.head(values.size()) = values;
  std::vector<double> areas;
  areas.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector2d e = mesh.vertices[b] - mesh.vertices[a], f = mesh.vertices[c] - mesh.vertices[a];
    areas.push_back(std::abs(e.x() * f.y() - e.y() * f.x()) / 2);
    for (const int v : {a, b, c}) area[v] += areas.back();
  }
  const double reach = range_px / (kStepReach * mesh.cell_px);
  const int steps = static_cast<int>(std::clamp(reach * reach, 1., double(kMostSteps)));
  for (int step = 0; step < steps; ++step) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(size);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      const double part = areas[t] * (mean[a] + mean[b] + mean[c]) / 3;
      sum[a] += part, sum[b] += part, sum[c] += part;
    }
    mean = sum.cwiseQuotient(area.cwiseMax(1e-12));
  }
  return mean;
}

}  // namespace skel
