#include "libskel/pipeline/facing.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "libskel/animation/figure_shape.h"
#include "libskel/animation/role_figure.h"

namespace skel {
namespace {

constexpr double kPi = std::numbers::pi;

double looksAt(const RiggedCharacter& character) {
  constexpr double kAnimal = -kPi / 2;
  const Skeleton& skeleton = character.skeleton;
  const bool biped = skeleton.find("left_foot") >= 0, animal = skeleton.find("left_front_foot") >= 0;
  if (character.facing) return character.facing->yaw_rad;
  if (biped) return 0;
  if (animal) return shapeOfBones(skeleton).yaw_rad + kAnimal;
  const std::optional<RoleFigure> figure = roleFigure(skeleton);
  if (!figure) return 0;
  const bool quadruped = figure->skeleton.find("left_front_foot") >= 0;
  const Eigen::Vector3d ours(quadruped ? -1 : 0, 0, quadruped ? 0 : 1),
      front = figure->to_ours.inverse() * ours;
  return std::atan2(front.x(), front.z());
}

}  // namespace

double facing(const RiggedCharacter& character) { return std::remainder(looksAt(character), 2 * kPi); }

std::string drawnFrom(double facing_rad) {
  const double off = std::abs(facing_rad);
  const std::string side = facing_rad < 0 ? "left" : "right";
  return off < kPi / 8       ? "from the front"
         : off > 7 * kPi / 8 ? "from behind"
         : off < 3 * kPi / 8 ? "half from the front, looking " + side
         : off > 5 * kPi / 8 ? "half from behind, looking " + side
                             : "looking " + side;
}

}  // namespace skel
