#include "stylizer/puppet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "libskel/core/error.h"
#include "libskel/mesh/planar_mesh.h"
#include "libskel/mesh/texture.h"
#include "libskel/skin/skin_weights.h"

namespace skel {
namespace {

constexpr int kMaxTexture_px = 2048;

// The part that a joint moves.
int partOf(const std::string& joint) {
  const auto index = [](const std::string& name) {
    return int(std::find(kPuppetParts.begin(), kPuppetParts.end(), name) - kPuppetParts.begin());
  };
  if (joint == "head" || joint == "head_top") return index("head");
  for (const std::string side : {"left_", "right_"}) {
    if (joint == side + "shoulder" || joint == side + "elbow" || joint == side + "hand")
      return index(side + "arm");
    if (joint == side + "hip" || joint == side + "knee" || joint == side + "foot") return index(side + "leg");
  }
  return index("body");
}

std::vector<int> ranks(const std::vector<std::string>& order) {
  std::vector<int> rank;
  for (const std::string& part : kPuppetParts)
    rank.push_back(int(std::find(order.begin(), order.end(), part) - order.begin()));
  if (order.size() != kPuppetParts.size() ||
      std::find(rank.begin(), rank.end(), int(order.size())) != rank.end()) {
    std::string names;
    for (const std::string& part : kPuppetParts) names += (names.empty() ? "" : ",") + part;
    throw UsageError("--order names each part once, back to front; the parts are " + names);
  }
  return rank;
}

PlanarMesh triangulated(const Silhouette& silhouette, int vertices) {
  std::vector<Polygon> outline;
  for (const Polygon& corners : silhouette.outline) outline.push_back(sideMiddles(corners));
  const PixelBox box = figureBox(silhouette.mask);
  double cell_px = std::max(0.7, std::sqrt(double((silhouette.mask > 0).count()) / vertices));
  PlanarMesh mesh = triangulateFigure(silhouette.mask, box, outline, cell_px);
  // Thin figures have more rim than the area tells.
  for (int i = 0; i < 3 && double(mesh.vertices.size()) > 1.2 * vertices; ++i) {
    cell_px *= std::sqrt(double(mesh.vertices.size()) / vertices);
    mesh = triangulateFigure(silhouette.mask, box, outline, cell_px);
  }
  return mesh;
}

}  // namespace

Puppet makePuppet(const Performer& performer, const SkeletonTemplate& body_plan,
                  const PuppetOptions& options) {
  const auto& [image, silhouette, skeleton] = performer;
  const std::vector<int> rank = ranks(options.order);
  const PlanarMesh planar = triangulated(silhouette, options.vertices);
  const Eigen::Index count = Eigen::Index(planar.vertices.size());
  Eigen::MatrixX2d vertices(count, 2);
  // The drawing laid flat on the model's plane, one px a metre.
  TriangleMesh flat;
  flat.vertices.resize(count, 3);
  for (Eigen::Index v = 0; v < count; ++v) {
    vertices.row(v) = planar.vertices[std::size_t(v)];
    flat.vertices.row(v) << float(vertices(v, 0)), float(-vertices(v, 1)), 0.f;
  }
  flat.triangles.resize(Eigen::Index(planar.triangles.size()), 3);
  for (Eigen::Index t = 0; t < flat.triangles.rows(); ++t)
    for (Eigen::Index k = 0; k < 3; ++k)
      flat.triangles(t, k) = planar.triangles[std::size_t(t)][std::size_t(k)];
  Skeleton on_plane = skeleton;
  for (Joint& joint : on_plane.joints) joint.position = {joint.image.x(), -joint.image.y(), 0};
  const SkinWeights weights = computeSkinWeights(flat, on_plane, SkinMethod::kGeodesic);

  std::vector<int> part(static_cast<std::size_t>(flat.triangles.rows()));
  for (Eigen::Index t = 0; t < flat.triangles.rows(); ++t) {
    std::vector<double> votes(kPuppetParts.size(), 0);
    for (Eigen::Index k = 0; k < 3; ++k)
      for (Eigen::Index i = 0; i < 4; ++i) {
        const Eigen::Index v = flat.triangles(t, k);
        votes[std::size_t(partOf(on_plane.joints[weights.joints(v, i)].name))] +=
            double(weights.weights(v, i));
      }
    part[std::size_t(t)] = int(std::max_element(votes.begin(), votes.end()) - votes.begin());
  }
  std::vector<Eigen::Index> order(part.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
    return rank[std::size_t(part[std::size_t(a)])] < rank[std::size_t(part[std::size_t(b)])];
  });
  Eigen::MatrixX3i triangles(flat.triangles.rows(), 3);
  std::vector<int> parts;
  for (std::size_t t = 0; t < order.size(); ++t) {
    triangles.row(Eigen::Index(t)) = flat.triangles.row(order[t]);
    parts.push_back(part[std::size_t(order[t])]);
  }

  PoseMatrix rest(2 * Eigen::Index(body_plan.joints.size()), 1);
  Eigen::MatrixX2d handles(Eigen::Index(body_plan.joints.size()), 2);
  for (std::size_t j = 0; j < body_plan.joints.size(); ++j) {
    const Eigen::Vector2d at = skeleton.joints[std::size_t(skeleton.index(body_plan.joints[j].name))].image;
    rest.col(0).segment<2>(2 * Eigen::Index(j)) = at;
    handles.row(Eigen::Index(j)) = at;
  }
  DrawingTexture texture = drawingTexture(image, silhouette.mask, figureBox(silhouette.mask), kMaxTexture_px);
  Eigen::MatrixX2d texture_places(count, 2);
  for (Eigen::Index v = 0; v < count; ++v)
    texture_places.row(v) = texture.uvFromImage(vertices.row(v).transpose())
                                .cwiseProduct(Eigen::Vector2d(texture.image.width, texture.image.height)) -
                            Eigen::Vector2d::Constant(0.5);
  ArapMesh mesh(vertices, triangles, handles);
  return {std::move(vertices),       std::move(triangles), std::move(parts), std::move(texture.image),
          std::move(texture_places), std::move(rest),      std::move(mesh)};
}

Eigen::MatrixX2d posedVertices(const Puppet& puppet, const Eigen::VectorXd& pose) {
  Eigen::MatrixX2d targets(pose.size() / 2, 2);
  for (Eigen::Index j = 0; j < targets.rows(); ++j) targets.row(j) = pose.segment<2>(2 * j);
  return puppet.mesh.deform(targets);
}

}  // namespace skel
