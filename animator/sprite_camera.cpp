#include "animator/sprite_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "libskel/pipeline/facing.h"

namespace skel {
namespace {

constexpr double kPi = std::numbers::pi;

// Clockwise on a map.
constexpr std::array<const char*, 16> kNames = {"s", "ssw", "sw", "wsw", "w", "wnw", "nw", "nnw",
                                                "n", "nne", "ne", "ene", "e", "ese", "se", "sse"};

// On the ground, below the middle of the joints.
Eigen::Vector3d groundPoint(const RiggedCharacter& character) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Joint& joint : character.skeleton.joints) middle += joint.position;
  middle /= double(std::max<std::size_t>(1, character.skeleton.joints.size()));
  middle.y() = double(character.mesh.vertices.col(1).minCoeff());
  return middle;
}

}  // namespace

std::vector<SpriteDirection> spriteDirections(const RiggedCharacter& character, int count) {
  if (count == 1) return {{"", 0}};
  const double front = facing(character);
  const int step = 16 / count, first = count == 2 ? 4 : 0;
  std::vector<SpriteDirection> directions;
  for (int i = first; i < first + 16; i += step)
    directions.push_back({kNames[std::size_t(i)], front + 2 * kPi * i / 16});
  return directions;
}

SpriteExtent SpriteExtent::with(const SpriteExtent& other) const {
  return {std::max(aside, other.aside), std::min(low, other.low), std::max(high, other.high)};
}

SpriteExtent SpriteExtent::grown(double by_m) const { return {aside + by_m, low - by_m, high + by_m}; }

SpriteExtent spriteExtent(const RiggedCharacter& character, const Eigen::MatrixX3f& points,
                          const std::vector<SpriteDirection>& directions, double pitch_rad) {
  const Eigen::Vector3d ground = groundPoint(character);
  SpriteExtent extent;
  for (const SpriteDirection& direction : directions) {
    Camera camera;
    camera.yaw_rad = direction.yaw_rad;
    camera.pitch_rad = pitch_rad;
    const Eigen::Matrix3d eye = eyeFromModel(camera);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const Eigen::Vector3d p = eye * (points.row(i).transpose().cast<double>() - ground);
      extent = extent.with({std::abs(p.x()), p.y(), p.y()});
    }
  }
  return extent;
}

SpriteCamera spriteCamera(const SpriteExtent& extent, double pitch_deg, int width, int height,
                          int margin_px) {
  const auto& [aside, low, high] = extent;
  // A pixel of the height is kept for the ground's whole number.
  const double px_per_m = std::min((width - 2.0 * margin_px) / (2 * aside),
                                   std::max(1.0, height - 2.0 * margin_px - 1) / (high - low));
  const int pivot_y = int(std::floor(height - margin_px + low * px_per_m));
  return spriteCamera({width, height, width / 2, pivot_y, px_per_m, pitch_deg});
}

SpriteCamera spriteCamera(const SpriteCell& cell) {
  SpriteCamera result;
  result.cell = cell;
  result.camera.pitch_rad = cell.pitch_deg * kPi / 180;
  result.camera.view_height_m = cell.height / cell.px_per_m;
  result.camera.distance_m = 50 * result.camera.view_height_m;
  return result;
}

BeyondCell beyondCell(const SpriteExtent& extent, const SpriteCell& cell) {
  const double aside = extent.aside * cell.px_per_m - std::min(cell.pivot_x, cell.width - cell.pivot_x),
               above = extent.high * cell.px_per_m - cell.pivot_y,
               below = -extent.low * cell.px_per_m - (cell.height - cell.pivot_y);
  const double most = std::max({0.0, aside, above, below});
  return {int(std::lround(most)), most == above ? "above" : most == below ? "below" : "at a side"};
}

Camera turned(const SpriteCamera& sprites, const RiggedCharacter& character, double yaw_rad) {
  Camera camera = sprites.camera;
  camera.yaw_rad = yaw_rad;
  const SpriteCell& cell = sprites.cell;
  const double m_per_px = camera.view_height_m / cell.height;
  const Eigen::Vector3d in_cell(cell.pivot_x - cell.width / 2.0, cell.height / 2.0 - cell.pivot_y, 0);
  camera.target = groundPoint(character) - eyeFromModel(camera).transpose() * (m_per_px * in_cell);
  return camera;
}

}  // namespace skel
