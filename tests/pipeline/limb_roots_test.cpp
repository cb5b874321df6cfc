// Limbs that are bodies of their own hang on the trunk.
#include "libskel/pipeline/limb_roots.h"

#include "libskel/mesh/inflate.h"
#include "libskel/skeleton/lift.h"
#include "tests/support/catch.h"
#include "tests/support/synthetic_figure.h"

using namespace skel;

namespace {

// A capsule figure whose right arm, from a little beyond the shoulder on, is a piece of its own.
struct Cut {
  CapsuleFigure of{.size = 400};
  Silhouette silhouette = silhouetteFromMask(capsuleMask(of));
  Skeleton skeleton = capsuleSkeleton(of);
  SkeletonTemplate body_plan = loadTemplate("biped");
  LayerMap layers;
  std::vector<FigurePiece> pieces;
  TriangleMesh mesh;
  SkinWeights weights;
  int limb = 0;  // the right arm's number

  explicit Cut(bool behind = false) {
    layers.limb = layers.part = Plane8::Zero(of.size, of.size);
    for (std::size_t k = 0; k < body_plan.limbs.size(); ++k)
      if (body_plan.joints[std::size_t(body_plan.limbs[k].joints[2])].name == "right_hand") limb = int(k) + 1;
    const Eigen::Vector2d from = at("right_shoulder"), to = at("right_hand");
    const Eigen::Vector2d along = (to - from).normalized();
    for (int y = 0; y < of.size; ++y)
      for (int x = 0; x < of.size; ++x) {
        const double beyond = (Eigen::Vector2d(x, y) - from).dot(along),
                     beside =
                         std::abs((Eigen::Vector2d(x, y) - from).dot(Eigen::Vector2d(-along.y(), along.x())));
        if (silhouette.mask(y, x) != 0 && beyond > of.limb_radius / 2. && beside <= of.limb_radius)
          layers.limb(y, x) = std::uint8_t(limb);
      }
    if (behind) layers.far.push_back(limb);
    pieces = figurePieces(layers, silhouette, skeleton, body_plan);
    mesh = inflate(capsuleImage(of), silhouette, {}, pieces);
    const std::vector<int> joint_layers = jointLayers(skeleton, body_plan, mesh, layers);
    liftToModel(skeleton, mesh, joint_layers);
    weights = computeSkinWeights(mesh, skeleton, SkinMethod::kGeodesic, {}, joint_layers);
  }
  Eigen::Vector2d at(const std::string& joint) const {
    return skeleton.joints[std::size_t(skeleton.index(joint))].image;
  }
  // Share of the trunk in the arm's vertex that is drawn nearest to a point.
  float trunkAt(const Eigen::Vector2d& image) const {
    const Eigen::RowVector2f p = mesh.model_from_image(image).cast<float>().transpose();
    Eigen::Index best = -1;
    float least = 1e9f;
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
      if (mesh.layer[v] != limb) continue;
      const float distance = (mesh.vertices.row(v).head<2>() - p).squaredNorm();
      if (distance < least) least = distance, best = v;
    }
    REQUIRE(best >= 0);
    const int carrier = skeleton.joints[std::size_t(skeleton.index("right_shoulder"))].parent;
    float share = 0;
    for (int k = 0; k < 4; ++k)
      if (weights.joints(best, k) == carrier) share += weights.weights(best, k);
    return share;
  }
};

}  // namespace

TEST_CASE(
    "what a limb's piece shares with the trunk stays with it, and the limb goes over to its own bones") {
  Cut figure;
  REQUIRE(figure.pieces.size() == 2);
  const Eigen::Vector2d shoulder = figure.at("right_shoulder"), elbow = figure.at("right_elbow");
  CHECK(figure.trunkAt(shoulder) < .1f);
  tieLimbRoots(figure.mesh, figure.body_plan, figure.pieces, figure.layers, figure.skeleton, figure.weights);
  CHECK(figure.trunkAt(shoulder) > .9f);
  const float between = figure.trunkAt(shoulder + figure.of.limb_radius * (elbow - shoulder).normalized());
  CHECK(between > .1f);
  CHECK(between < .95f);
  CHECK(figure.trunkAt(elbow) == 0);
  for (Eigen::Index v = 0; v < figure.weights.weights.rows(); ++v)
    REQUIRE(std::abs(figure.weights.weights.row(v).sum() - 1) < 1e-4f);
}

TEST_CASE("a limb behind the trunk hangs as it did, the trunk hides its root") {
  Cut figure(true);
  const SkinWeights before = figure.weights;
  tieLimbRoots(figure.mesh, figure.body_plan, figure.pieces, figure.layers, figure.skeleton, figure.weights);
  CHECK((before.joints == figure.weights.joints && before.weights.isApprox(figure.weights.weights, 1e-6f)));
}
