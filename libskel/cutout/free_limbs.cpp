#include "libskel/cutout/free_limbs.h"

#include <algorithm>
#include <array>

#include "libskel/cutout/limb_plane.h"

namespace skel {
namespace {

using Eigen::Vector2d;

constexpr double kRoot = 0.9;      // of the limb's width, about its root
constexpr double kTouches = 0.15;  // of its length, elsewhere
constexpr double kHolds = 0.02;    // of its pixels

}  // namespace

LayerMap withoutFreeLimbs(const DrawnFigure& figure, LayerMap layers) {
  if (!layers.any()) return layers;
  const Plane8 labels = layers.limb;
  const Plane8& part = layers.part;
  const std::vector<double> widths = limbWidths(figure, labels);
  std::array<LimbBones, 5> bones;
  for (std::size_t limb = 1; limb < widths.size(); ++limb)
    if (limb <= figure.body_plan.limbs.size()) bones[limb] = limbBones(figure, limb);
  std::array<int, 5> pixels{}, holds{}, touches{};
  for (int y = 0; y < labels.rows(); ++y)
    for (int x = 0; x < labels.cols(); ++x) {
      const std::uint8_t here = labels(y, x);
      ++pixels[here];
      if (part.size() != 0 && part(y, x) == std::uint8_t(Part::kThing)) ++holds[here];
      for (const auto& [v, u] : {std::pair(y, x + 1), std::pair(y + 1, x)}) {
        if (v >= labels.rows() || u >= labels.cols() || labels(v, u) == here) continue;
        if (figure.silhouette.mask(y, x) == 0 || figure.silhouette.mask(v, u) == 0) continue;
        for (const std::uint8_t limb : {here, labels(v, u)})
          if ((Vector2d(x, y) - bones[limb].joints[0]).norm() > kRoot * widths[limb]) ++touches[limb];
      }
    }
  for (std::size_t limb = 1; limb < widths.size(); ++limb) {
    const bool far = std::count(layers.far.begin(), layers.far.end(), int(limb)) != 0;
    if (pixels[limb] > 0 && !far && touches[limb] < kTouches * bones[limb].length() &&
        holds[limb] < kHolds * pixels[limb])
      layers.limb =
          (labels == std::uint8_t(limb)).select(Plane8::Zero(labels.rows(), labels.cols()), layers.limb);
  }
  if ((layers.limb == 0).all()) layers.limb = Plane8();
  return layers;
}

}  // namespace skel
