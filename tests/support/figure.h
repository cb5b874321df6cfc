// A character of tubes and a ball with known joints, textured and skinned, in any pose of its arms: for tests
// of what comes after recognition.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "libskel/export/write_character.h"

namespace skel {

// Angles in degrees, from straight down outwards, in the picture's plane.
struct FigurePose {
  double right_arm = 20, right_forearm = 20;
  double left_arm = 20, left_forearm = 20;
  double leg = 8;
  double head_radius = 0.13;
};

inline Skeleton figureSkeleton(const FigurePose& pose = {}) {
  Skeleton skeleton;
  skeleton.template_name = "biped";
  const auto add = [&](const std::string& name, const std::string& parent, double x, double y) {
    Joint joint;
    joint.name = name;
    joint.parent = parent.empty() ? -1 : skeleton.index(parent);
    joint.position = {x, y, 0};
    joint.image = {300 + 300 * x, 540 - 300 * y};
    joint.confidence = 1;
    joint.origin = JointOrigin::kRecognized;
    skeleton.joints.push_back(joint);
  };
  const auto at = [&](const std::string& name) { return skeleton.joints[skeleton.index(name)].position; };
  const auto limb = [&](const std::string& name, const std::string& parent, double degrees, double length) {
    const double angle = degrees * std::numbers::pi / 180, side = name[0] == 'r' ? -1 : 1;
    add(name, parent, at(parent).x() + side * length * std::sin(angle),
        at(parent).y() - length * std::cos(angle));
  };
  add("pelvis", "", 0, 0.8);
  add("body", "pelvis", 0, 1.05);
  add("neck", "body", 0, 1.3);
  add("head", "neck", 0, 1.35 + pose.head_radius);
  add("head_top", "head", 0, 1.35 + 2 * pose.head_radius);
  for (const std::string side : {"right_", "left_"}) {
    const double sign = side == "right_" ? -1 : 1;
    add(side + "shoulder", "neck", sign * 0.17, 1.27);
    limb(side + "elbow", side + "shoulder", side == "right_" ? pose.right_arm : pose.left_arm, 0.27);
    limb(side + "hand", side + "elbow", side == "right_" ? pose.right_forearm : pose.left_forearm, 0.25);
    add(side + "hip", "pelvis", sign * 0.1, 0.77);
    limb(side + "knee", side + "hip", pose.leg, 0.38);
    limb(side + "foot", side + "knee", pose.leg, 0.36);
  }
  return skeleton;
}

// The same standing on the head.
inline Skeleton upsideDown(Skeleton skeleton) {
  double top = 0;
  for (const Joint& joint : skeleton.joints) top = std::max(top, joint.position.y());
  for (Joint& joint : skeleton.joints)
    joint.position = {-joint.position.x(), top - joint.position.y(), joint.position.z()};
  return skeleton;
}

// Tubes along the bones, each bound to its joint and, near the joint, half to the parent.
inline RiggedCharacter figure(const FigurePose& pose = {}) {
  RiggedCharacter character;
  character.skeleton = figureSkeleton(pose);
  const Skeleton& skeleton = character.skeleton;
  constexpr int kSides = 12, kRings = 9;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> joints;
  std::vector<float> weights;  // of the first of the two joints
  const auto tube = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius, int joint,
                        int parent) {
    const Eigen::Vector3d axis = (to - from).normalized();
    const Eigen::Vector3d side = axis.cross(Eigen::Vector3d::UnitZ()).normalized();
    const int first = int(vertices.size());
    for (int ring = 0; ring < kRings; ++ring) {
      const double t = double(ring) / (kRings - 1);
      // Round ends: half circles in the first and the last rings.
      const double round = std::sqrt(std::max(0.02, 1 - std::pow(2 * t - 1, 6)));
      for (int k = 0; k < kSides; ++k) {
        const double angle = 2 * std::numbers::pi * k / kSides;
        vertices.push_back(from + t * (to - from) +
                           round * radius *
                               (std::cos(angle) * side + std::sin(angle) * Eigen::Vector3d::UnitZ()));
        joints.push_back({joint, parent < 0 ? joint : parent});
        weights.push_back(parent < 0 ? 1.0f : float(std::min(1.0, 0.5 + 2 * t)));
      }
    }
    const auto at = [&](int ring, int k) { return first + ring * kSides + k % kSides; };
    for (int ring = 0; ring + 1 < kRings; ++ring)
      for (int k = 0; k < kSides; ++k) {
        triangles.push_back({at(ring, k), at(ring + 1, k + 1), at(ring, k + 1)});
        triangles.push_back({at(ring, k), at(ring + 1, k), at(ring + 1, k + 1)});
      }
    for (int k = 1; k + 1 < kSides; ++k) {
      triangles.push_back({at(0, 0), at(0, k), at(0, k + 1)});
      triangles.push_back({at(kRings - 1, 0), at(kRings - 1, k + 1), at(kRings - 1, k)});
    }
  };
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    std::vector<Eigen::Vector3d> ends;
    for (const Joint& child : skeleton.joints)
      if (child.parent == int(j)) ends.push_back(child.position);
    if (ends.empty()) {  // the tip beyond a leaf
      const Eigen::Vector3d back = joint.position - skeleton.joints[joint.parent].position;
      ends.push_back(joint.position + 0.35 * std::min(back.norm(), 0.2) * back.normalized());
    }
    const double radius = joint.name == "head" || joint.name == "head_top" ? pose.head_radius
                          : joint.name == "pelvis" || joint.name == "body" ? 0.12
                                                                           : 0.05;
    if (joint.name == "head") {
      const Eigen::Vector3d up(0, pose.head_radius, 0);
      tube(joint.position - up, joint.position + up, radius, int(j), joint.parent);
    } else if (joint.name != "head_top") {
      for (const Eigen::Vector3d& end : ends) tube(joint.position, end, radius, int(j), joint.parent);
    }
  }

  TriangleMesh& mesh = character.mesh;
  const Eigen::Index count = Eigen::Index(vertices.size());
  mesh.vertices.resize(count, 3);
  mesh.uv.resize(count, 2);
  character.weights.joints.setZero(count, 4);
  character.weights.weights.setZero(count, 4);
  for (Eigen::Index i = 0; i < count; ++i) {
    mesh.vertices.row(i) = vertices[i].cast<float>();
    mesh.uv(i, 0) = std::clamp(mesh.vertices(i, 0) / 1.8f + 0.5f, 0.0f, 1.0f);
    mesh.uv(i, 1) = std::clamp(1 - mesh.vertices(i, 1) / 2, 0.0f, 1.0f);
    const int heavy = weights[i] >= 0.5f ? 0 : 1;
    const float weight = std::max(weights[i], 1 - weights[i]);
    character.weights.joints(i, 0) = std::uint16_t(joints[i][heavy]);
    character.weights.weights(i, 0) = weight;
    if (weight < 1) {
      character.weights.joints(i, 1) = std::uint16_t(joints[i][1 - heavy]);
      character.weights.weights(i, 1) = 1 - weight;
    }
  }
  mesh.triangles.resize(Eigen::Index(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    mesh.triangles.row(Eigen::Index(t)) << triangles[t][0], triangles[t][1], triangles[t][2];

  // Right arm red, left arm blue, trunk yellow, legs green, with stripes that show the texture's direction.
  mesh.texture = Image(180, 200);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 180; ++x) {
      std::uint8_t* pixel = mesh.texture.pixel(x, y);
      const int shade = y / 5 % 2 == 0 ? 0 : 40;
      const int r = y > 120 ? 90 : x < 73 ? 230 : x > 107 ? 80 : 240;
      const int g = y > 120 ? 180 : x < 73 ? 90 : x > 107 ? 120 : 200;
      const int b = y > 120 ? 90 : x < 73 ? 80 : x > 107 ? 230 : 90;
      pixel[0] = std::uint8_t(r - shade), pixel[1] = std::uint8_t(g - shade),
      pixel[2] = std::uint8_t(b - shade);
      pixel[3] = 255;
    }
  return character;
}

}  // namespace skel
