// A figure of capsules with exactly known joints, as a mask: truth for the estimators without any file.
#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "libskel/image/image.h"
#include "libskel/skeleton/skeleton.h"

namespace skel {

// Lengths in px of an image of size × size; angles in degrees from straight down outwards.
struct CapsuleFigure {
  int size = 400;
  double right_arm = 40, right_forearm = 40, left_arm = 40, left_forearm = 40;
  double right_thigh = 12, right_shin = 12, left_thigh = 12, left_shin = 12;
  double limb_radius = 13, trunk_radius = 40, head_radius = 42;
};

// The 17 joints of the biped in image px; positions are not set.
inline Skeleton capsuleSkeleton(const CapsuleFigure& figure = {}) {
  Skeleton skeleton;
  skeleton.template_name = "biped";
  const auto add = [&](const std::string& name, const std::string& parent, const Eigen::Vector2d& at) {
    Joint joint;
    joint.name = name;
    joint.parent = skeleton.find(parent);
    joint.image = at;
    joint.confidence = 1;
    joint.origin = JointOrigin::kRecognized;
    skeleton.joints.push_back(joint);
  };
  const double unit = figure.size / 400.0, middle = 0.5 * (figure.size - 1);
  const auto limb = [&](const std::string& name, const std::string& parent, double degrees, double length) {
    const double angle = degrees * std::numbers::pi / 180, side = name[0] == 'r' ? -1 : 1;
    const Eigen::Vector2d from = skeleton.joints[skeleton.index(parent)].image;
    add(name, parent, from + length * unit * Eigen::Vector2d(side * std::sin(angle), std::cos(angle)));
  };
  add("pelvis", "", {middle, 235 * unit});
  add("body", "pelvis", {middle, 190 * unit});
  add("neck", "body", {middle, 140 * unit});
  add("head", "neck", {middle, 75 * unit});
  add("head_top", "head", {middle, 38 * unit});
  for (const std::string side : {"right_", "left_"}) {
    const bool right = side == "right_";
    const double sign = right ? -1 : 1;
    add(side + "shoulder", "neck", {middle + sign * 36 * unit, 145 * unit});
    limb(side + "elbow", side + "shoulder", right ? figure.right_arm : figure.left_arm, 62);
    limb(side + "hand", side + "elbow", right ? figure.right_forearm : figure.left_forearm, 58);
    add(side + "hip", "pelvis", {middle + sign * 24 * unit, 240 * unit});
    limb(side + "knee", side + "hip", right ? figure.right_thigh : figure.left_thigh, 70);
    limb(side + "foot", side + "knee", right ? figure.right_shin : figure.left_shin, 65);
  }
  return skeleton;
}

inline Plane8 capsuleMask(const CapsuleFigure& figure = {}) {
  const Skeleton skeleton = capsuleSkeleton(figure);
  Plane8 mask = Plane8::Zero(figure.size, figure.size);
  const double unit = figure.size / 400.0;
  const auto capsule = [&](const std::string& from, const std::string& to, double radius) {
    const Eigen::Vector2d a = skeleton.joints[skeleton.index(from)].image;
    const Eigen::Vector2d along = skeleton.joints[skeleton.index(to)].image - a;
    for (int y = 0; y < figure.size; ++y) {
      for (int x = 0; x < figure.size; ++x) {
        const Eigen::Vector2d p = Eigen::Vector2d(x, y) - a;
        const double length2 = along.squaredNorm();
        const double t = length2 > 0 ? std::min(1.0, std::max(0.0, p.dot(along) / length2)) : 0;
        if ((p - t * along).norm() <= radius * unit) mask(y, x) = 255;
      }
    }
  };
  capsule("pelvis", "neck", figure.trunk_radius);
  capsule("neck", "head", 15);
  capsule("head", "head", figure.head_radius);
  for (const std::string side : {"right_", "left_"}) {
    capsule("neck", side + "shoulder", figure.limb_radius);
    capsule("pelvis", side + "hip", figure.limb_radius + 2);
    capsule(side + "shoulder", side + "elbow", figure.limb_radius);
    capsule(side + "elbow", side + "hand", figure.limb_radius);
    capsule(side + "hip", side + "knee", figure.limb_radius + 2);
    capsule(side + "knee", side + "foot", figure.limb_radius + 2);
  }
  return mask;
}

// As a picture: dark blue on white.
inline Image capsuleImage(const CapsuleFigure& figure = {}) {
  const Plane8 mask = capsuleMask(figure);
  Image image(figure.size, figure.size);
  for (int y = 0; y < figure.size; ++y) {
    for (int x = 0; x < figure.size; ++x) {
      const bool in = mask(y, x) != 0;
      std::uint8_t* p = image.pixel(x, y);
      p[0] = in ? 60 : 255, p[1] = in ? 80 : 255, p[2] = in ? 160 : 255, p[3] = 255;
    }
  }
  return image;
}

}  // namespace skel
