#include "libskel/pipeline/limb_roots.h"

#include <cmath>
#include <vector>

#include "libskel/pipeline/smooth_step.h"
#include "libskel/skin/bones.h"
#include "libskel/skin/smooth.h"
#include "libskel/skin/vertex_tree.h"

namespace skel {
namespace {

using Eigen::Index;

constexpr double kRootReach =
    1.3;  // times half of the limb's width: so far about its first joint is its root

bool isOn(const Plane8& plane, Index x, Index y) {
  return x >= 0 && y >= 0 && x < plane.cols() && y < plane.rows() && plane(y, x) != 0;
}

// Ties the piece that hangs on `joint`.
void tie(const TriangleMesh& mesh, const FigurePiece& piece, const LayerMap& layers, const Joint& joint,
         JointWeights& rows) {
  std::vector<int> own;
  std::vector<char> shared;  // of them: about the joint, and drawn as the trunk's
  Eigen::MatrixX3f places = Eigen::MatrixX3f::Zero(mesh.vertices.rows(), 3);  // in the drawing, px
  for (Index v = 0; v < mesh.vertices.rows(); ++v) {
    if (mesh.layer[v] != piece.layer) continue;
    const Eigen::Vector2d at =
        mesh.model_from_image.inverse(mesh.vertices.row(v).head<2>().transpose().cast<double>());
    places.row(v).head<2>() = at.transpose().cast<float>();
    const Index x = std::lround(at.x()), y = std::lround(at.y());
    own.push_back(static_cast<int>(v));
    shared.push_back(!isOn(layers.limb, x, y) && isOn(piece.mask, x - piece.box.x0, y - piece.box.y0) &&
                     (at - joint.image).norm() <= kRootReach * piece.root_px);
  }
  VertexTree trunk(places);
  for (std::size_t i = 0; i < own.size(); ++i)
    if (shared[i]) trunk.add(own[i]);
  const auto over_px = static_cast<float>(piece.root_px);
  for (const int v : own) {
    const VertexTree::Found nearest = trunk.nearest(places.row(v), over_px);
    if (nearest.vertex < 0) continue;
    const float share = 1 - smoothStep(nearest.distance_m / over_px);
    rows.row(v) *= 1 - share;
    rows(v, joint.parent) += share;
  }
}

}  // namespace

void tieLimbRoots(const TriangleMesh& mesh, const SkeletonTemplate& body_plan,
                  const std::vector<FigurePiece>& pieces, const LayerMap& layers, const Skeleton& skeleton,
                  SkinWeights& weights) {
  if (pieces.empty() || !layers.any()) return;
  JointWeights rows = unpackWeights(weights, static_cast<int>(skeleton.joints.size()));
  for (const FigurePiece& piece : pieces) {
    if (piece.layer == 0 || piece.behind) continue;
    const TemplateLimb& limb = body_plan.limbs[static_cast<std::size_t>(piece.layer - 1)];
    const int first = skeleton.find(body_plan.joints[static_cast<std::size_t>(limb.joints[0])].name);
    if (first < 0 || skeleton.joints[static_cast<std::size_t>(first)].parent < 0) continue;
    tie(mesh, piece, layers, skeleton.joints[static_cast<std::size_t>(first)], rows);
  }
  keepHeaviest(4, rows);
  weights = packWeights(rows);
}

}  // namespace skel
