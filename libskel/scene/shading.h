// Inside the room: the light, which all painters share with draw/render_mesh.cpp.
#pragma once

#include <Eigen/Core>

namespace skel {

// To the light, in the eye's axes.
inline Eigen::Vector3f lightDirection() { return Eigen::Vector3f(-0.35f, 0.55f, 0.76f).normalized(); }

// Full light on what faces it within 45°, so that most of the front shows the drawing's own colours.
inline constexpr float kLightReach = 0.3f;

}  // namespace skel
