// How well weights carry a mesh.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "libskel/deform/skin_vertices.h"
#include "libskel/skin/methods.h"

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
inline JointTransforms bent(const Skeleton& skeleton, const std::string& joint, int way, float degrees = 90) {
  const int j = skeleton.index(joint);
  const Eigen::Vector3f bone =
      (skeleton.joints[j].position - skeleton.joints[skeleton.joints[j].parent].position).cast<float>();
  const Eigen::Vector3f axis =
      way < 2 ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f(bone.cross(Eigen::Vector3f::UnitZ()).normalized());
  std::vector<Eigen::Quaternionf> rotations(skeleton.joints.size(), Eigen::Quaternionf::Identity());
  rotations[j] = Eigen::AngleAxisf((way % 2 ? 1 : -1) * degrees / 180 * std::numbers::pi_v<float>, axis);
  return posedFromRest(skeleton, rotations);
}

// Whether the way from a to b, image px, lies in the figure.
inline bool inFigure(const Plane8& mask, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const int steps = static_cast<int>(2 * (b - a).norm()) + 1;
  for (int k = 0; k <= steps; ++k) {
    const Eigen::Vector2d p = a + (b - a) * k / steps;
    const auto x = std::lround(p.x()), y = std::lround(p.y());
    if (x < 0 || y < 0 || x >= mask.cols() || y >= mask.rows() || mask(y, x) == 0) return false;
  }
  return true;
}

// How far the hand (the foot) turns about the elbow (the knee) when that is bent in the drawing's plane: the
// mean share of the asked angle, over the vertices straight beside the last two fifths of the forearm (the
// shin). 0: there are none.
inline double turnedShare(const Plane8& mask, const TriangleMesh& mesh, const SkinWeights& weights,
                          const Skeleton& skeleton, const std::string& joint, float degrees) {
  const int j = skeleton.index(joint);
  const auto flat = [](const Eigen::Vector3d& p) { return Eigen::Vector2f(p.head<2>().cast<float>()); };
  const Eigen::Vector2f from = flat(skeleton.joints[j].position);
  const Eigen::Vector2f bone = flat(skeleton.joints[j + 1].position) - from;
  const Eigen::Vector2d from_px = skeleton.joints[j].image, bone_px = skeleton.joints[j + 1].image - from_px;
  const double px_per_m = bone_px.norm() / static_cast<double>(bone.norm());
  const Eigen::MatrixX3f posed = skinVertices(mesh.vertices, weights, bent(skeleton, joint, 1, degrees));
  double sum = 0;
  int count = 0;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    const Eigen::Vector2f rest = mesh.vertices.row(v).head<2>().transpose() - from;
    const float along = rest.dot(bone) / bone.squaredNorm();
    if (along < 0.6f || along > 1) continue;
    const Eigen::Vector2d across = px_per_m * (rest - along * bone).cast<double>();
    const Eigen::Vector2d beside = from_px + static_cast<double>(along) * bone_px;
    if (!inFigure(mask, beside, beside + 0.9 * Eigen::Vector2d(across.x(), -across.y()))) continue;
    const Eigen::Vector2f now = posed.row(v).head<2>().transpose() - from;
    const float turn_rad = std::atan2(rest.x() * now.y() - rest.y() * now.x(), rest.dot(now));
    sum += static_cast<double>(turn_rad * 180 / std::numbers::pi_v<float> / degrees);
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

// Whether the forearm (the shin) and the hand (the foot) touch nothing but their own limb, and the figure is
// nowhere wider across the bone than four fifths of its length.
inline bool isFree(const Plane8& mask, const TriangleMesh& mesh, const Skeleton& skeleton,
                   const std::string& joint) {
  const int j = skeleton.index(joint);
  const Eigen::Vector2d from = skeleton.joints[j].image, bone = skeleton.joints[j + 1].image - from;
  const Eigen::Vector2d across = Eigen::Vector2d(-bone.y(), bone.x()).normalized();
  for (int step = 0; step <= 10; ++step) {
    double width = 0;
    const Eigen::Vector2d p = from + 0.1 * step * bone;
    for (const double side : {-1.0, 1.0}) {
      for (double way = 0; way < bone.norm() && inFigure(mask, p, p + side * way * across); ++way) ++width;
    }
    if (width > 0.8 * bone.norm()) return false;
  }
  const std::vector<int> limbs = jointLimbs(skeleton);
  const std::vector<Bone> bones = skeletonBones(skeleton);
  const SkinOptions options;
  const JointWeights near = geodesicWeights({mesh, skeleton, bones, options});
  const auto nearest = [&](int v) {
    Eigen::Index result;
    near.row(v).maxCoeff(&result);
    return static_cast<int>(result);
  };
  const Eigen::Vector3f elbow = skeleton.joints[j].position.cast<float>();
  const Eigen::Vector3f forearm = skeleton.joints[j + 1].position.cast<float>() - elbow;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.triangles(t, k), moved = nearest(v);
      if (moved != j && moved != j + 1) continue;
      // Where the limb begins it may hang on anything.
      if ((mesh.vertices.row(v).transpose() - elbow).dot(forearm) < 0.1f * forearm.squaredNorm()) continue;
      for (int other = 0; other < 3; ++other) {
        if (limbs[nearest(mesh.triangles(t, other))] != limbs[j]) return false;
      }
    }
  }
  return true;
}

inline const char* const kBends[] = {"left_elbow", "right_elbow", "left_knee", "right_knee"};

}  // namespace skel
