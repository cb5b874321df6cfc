#include "animator/orbit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skel {

void orbit(Camera& camera, double across_px, double down_px, int height_px) {
  camera.yaw_rad =
      std::remainder(camera.yaw_rad - std::numbers::pi * across_px / height_px, 2 * std::numbers::pi);
  // Never over the top, where left and right would change places.
  constexpr double kSteepest_rad = 0.49 * std::numbers::pi;
  camera.pitch_rad =
      std::clamp(camera.pitch_rad + std::numbers::pi * down_px / height_px, -kSteepest_rad, kSteepest_rad);
}

void pan(Camera& camera, double across_px, double down_px, int height_px) {
  const double metre_per_px = camera.view_height_m / height_px;
  camera.target += eyeFromModel(camera).transpose() * Eigen::Vector3d(-across_px, down_px, 0) * metre_per_px;
}

void zoom(Camera& camera, double factor, double across_px, double down_px, int height_px) {
  // As a share of the distance: the eye stays outside.
  const double before = camera.view_height_m;
  camera.view_height_m = std::clamp(before / factor, 0.005 * camera.distance_m, 2 * camera.distance_m);
  const double moved_px = 1 - before / camera.view_height_m;
  pan(camera, across_px * moved_px, down_px * moved_px, height_px);
}

}  // namespace skel
