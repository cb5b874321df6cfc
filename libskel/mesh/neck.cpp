#include "libskel/mesh/neck.h"

#include <algorithm>
#include <cmath>

namespace skel {
namespace {

constexpr double kThroatReach = 0.2;  // of the reach: where the deepest place is sought
constexpr double kNeckAside = 0.6;    // of the width, beyond it: where the profile ends
constexpr double kLeastNeck = 0.55;

}  // namespace

Eigen::VectorXd neckProfile(const PlanarMesh& mesh, const Eigen::VectorXd& z, const DepthNeck& neck) {
  struct Place {
    double along, aside;  // in reaches; beyond the width, in widths
  };
  std::vector<Place> places;
  double deepest = 0;
  for (int v = 0; v < mesh.inner_count; ++v) {
    const Eigen::Vector2d d = mesh.vertices[static_cast<std::size_t>(v)] - neck.at;
    const double up = d.dot(neck.up), across = std::sqrt(std::max(0., d.squaredNorm() - up * up));
    places.push_back({std::abs(up) / neck.reach_px, std::max(0., across / neck.wide_px - 1)});
    if (places.back().along < kThroatReach && places.back().aside == 0) deepest = std::max(deepest, z[v]);
  }
  Eigen::VectorXd factors = Eigen::VectorXd::Ones(z.size());
  if (deepest <= neck.depth_px) return factors;
  const double factor = std::max(kLeastNeck, neck.depth_px / deepest);
  for (int v = 0; v < mesh.inner_count; ++v) {
    const auto [along, aside] = places[static_cast<std::size_t>(v)];
    if (along >= 1) continue;
    const double share = std::pow(1 - along * along, 2) * std::max(0., 1 - aside / kNeckAside);
    factors[v] = 1 - share * (1 - factor);
  }
  return factors;
}

}  // namespace skel
