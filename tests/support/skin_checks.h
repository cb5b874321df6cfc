// How well weights carry a mesh.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "libskel/deform/skin_vertices.h"

namespace skel {

inline Eigen::MatrixXf denseWeights(const SkinWeights& weights, const Skeleton& skeleton) {
  Eigen::MatrixXf dense =
      Eigen::MatrixXf::Zero(weights.weights.rows(), static_cast<Eigen::Index>(skeleton.joints.size()));
  for (Eigen::Index v = 0; v < weights.weights.rows(); ++v) {
    for (int k = 0; k < 4; ++k) dense(v, weights.joints(v, k)) += weights.weights(v, k);
  }
  return dense;
}

// 0 and 1 the arms, 2 and 3 the legs, -1 the trunk and the head of a biped.
inline int bipedLimb(const std::string& joint) {
  const bool left = joint.starts_with("left_");
  for (const char* part : {"shoulder", "elbow", "hand"}) {
    if (joint.ends_with(part)) return left ? 0 : 1;
  }
  for (const char* part : {"hip", "knee", "foot"}) {
    if (joint.ends_with(part)) return left ? 2 : 3;
  }
  return -1;
}

// Of the weight of the vertices that belong to a limb, the largest share that lies on another limb's joints.
inline double foreignShare(const SkinWeights& weights, const Skeleton& skeleton) {
  const Eigen::MatrixXf dense = denseWeights(weights, skeleton);
  double own[4] = {}, foreign[4] = {};
  for (Eigen::Index v = 0; v < dense.rows(); ++v) {
    Eigen::Index heaviest;
    dense.row(v).maxCoeff(&heaviest);
    const int limb = bipedLimb(skeleton.joints[heaviest].name);
    if (limb < 0) continue;
    for (Eigen::Index j = 0; j < dense.cols(); ++j) {
      const int other = bipedLimb(skeleton.joints[j].name);
      own[limb] += dense(v, j);
      if (other >= 0 && other != limb) foreign[limb] += dense(v, j);
    }
  }
  double worst = 0;
  for (int limb = 0; limb < 4; ++limb) {
    if (own[limb] > 0) worst = std::max(worst, foreign[limb] / own[limb]);
  }
  return worst;
}

inline float largestEdgeChange(const TriangleMesh& mesh, const SkinWeights& weights,
                               const Skeleton& skeleton) {
  const Eigen::MatrixXf dense = denseWeights(weights, skeleton);
  float worst = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles(t, k), b = mesh.triangles(t, (k + 1) % 3);
      worst = std::max(worst, (dense.row(a) - dense.row(b)).cwiseAbs().maxCoeff());
    }
  }
  return worst;
}

// Triangles that face the wrong way, compared with their own rest normal turned by the mean of their corners'
// joints: so that one that was edge-on at rest, or lies on the rim, is judged by where it should look now,
// not by where the viewer stands.
inline int insideOut(const TriangleMesh& mesh, const SkinWeights& weights,
                     const JointTransforms& posed_from_rest) {
  const Eigen::MatrixX3f posed = skinVertices(mesh.vertices, weights, posed_from_rest);
  int count = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const auto normal = [&](const Eigen::MatrixX3f& vertices) -> Eigen::Vector3f {
      const Eigen::Vector3f a = vertices.row(mesh.triangles(t, 0)), b = vertices.row(mesh.triangles(t, 1)),
                            c = vertices.row(mesh.triangles(t, 2));
      return (b - a).cross(c - a);
    };
    Eigen::Matrix3f rotation = Eigen::Matrix3f::Zero();
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 4; ++i) {
        const int v = mesh.triangles(t, k);
        rotation += weights.weights(v, i) * posed_from_rest[weights.joints(v, i)].linear();
      }
    }
    if (normal(posed).dot(rotation * normal(mesh.vertices)) <= 0) ++count;
  }
  return count;
}

// A joint bent by 90° in the drawing's plane, to either side, or out of it, forwards or backwards: `way` 0…3.
inline JointTransforms bent(const Skeleton& skeleton, const std::string& joint, int way) {
  const int j = skeleton.index(joint);
  const Eigen::Vector3f bone =
      (skeleton.joints[j].position - skeleton.joints[skeleton.joints[j].parent].position).cast<float>();
  const Eigen::Vector3f axis =
      way < 2 ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f(bone.cross(Eigen::Vector3f::UnitZ()).normalized());
  std::vector<Eigen::Quaternionf> rotations(skeleton.joints.size(), Eigen::Quaternionf::Identity());
  rotations[j] = Eigen::AngleAxisf((way % 2 ? 0.5f : -0.5f) * std::numbers::pi_v<float>, axis);
  return posedFromRest(skeleton, rotations);
}

inline const char* const kBends[] = {"left_elbow", "right_elbow", "left_knee", "right_knee"};

}  // namespace skel
