#include "libskel/draw/oklab.h"

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "libskel/image/srgb.h"

namespace skel {
namespace {

const Eigen::Matrix3f kConesFromLinear =
    (Eigen::Matrix3f() << 0.4122214708f, 0.5363325363f, 0.0514459929f, 0.2119034982f, 0.6806995451f,
     0.1073969566f, 0.0883024619f, 0.2817188376f, 0.6299787005f)
        .finished();
const Eigen::Matrix3f kLabFromRoots =
    (Eigen::Matrix3f() << 0.2104542553f, 0.7936177850f, -0.0040720468f, 1.9779984951f, -2.4285922050f,
     0.4505937099f, 0.0259040371f, 0.7827717662f, -0.8086757660f)
        .finished();

std::array<float, 256> makeLinear() {
  std::array<float, 256> linear;
  for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = linearFromSrgb(float(i));
  return linear;
}

}  // namespace

Eigen::Vector3f oklabFromSrgb(Color color) {
  static const std::array<float, 256> kLinear = makeLinear();
  const Eigen::Vector3f cones =
      kConesFromLinear * Eigen::Vector3f(kLinear[color.r], kLinear[color.g], kLinear[color.b]);
  return kLabFromRoots * Eigen::Vector3f(std::cbrt(cones[0]), std::cbrt(cones[1]), std::cbrt(cones[2]));
}

Color srgbFromOklab(const Eigen::Vector3f& lab) {
  static const Eigen::Matrix3f kRootsFromLab = kLabFromRoots.inverse();
  static const Eigen::Matrix3f kLinearFromCones = kConesFromLinear.inverse();
  const Eigen::Vector3f linear = kLinearFromCones * (kRootsFromLab * lab).array().cube().matrix();
  return {srgbFromLinear(linear[0]), srgbFromLinear(linear[1]), srgbFromLinear(linear[2])};
}

}  // namespace skel
