#include "trainer/posable_drawing.h"

#include <algorithm>
#include <numbers>

#include "libskel/core/error.h"
#include "libskel/core/parallel.h"
#include "libskel/deform/skin_vertices.h"
#include "libskel/draw/render_mesh.h"
#include "libskel/image/read_image.h"
#include "libskel/mesh/inflate.h"
#include "libskel/recognition/complete_skeleton.h"
#include "libskel/skeleton/lift.h"

namespace skel {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kTrunkTurn = 6 * kDegree, kArmTurn = 35 * kDegree, kLegTurn = 14 * kDegree;
constexpr double kLayer_m = 0.25;  // arms and legs before the body or behind it
constexpr int kPictureSize = 400;  // px of the rendered drawing, before its box is cut out

PosableDrawing posable(const JointedDrawing& drawing, const std::vector<std::string>& names,
                       const SkeletonTemplate& body_plan) {
  const Image image = readImage(drawing.image);
  const Silhouette silhouette = silhouetteOf(image, drawing);
  Skeleton skeleton = presetSkeleton(body_plan, {0, 0}, {1, 1});
  std::vector<bool> placed(skeleton.joints.size(), false);
  PosableDrawing out;
  for (const std::string& name : names) {
    const auto found = std::find_if(drawing.joints.begin(), drawing.joints.end(),
                                    [&](const auto& joint) { return joint.first == name; });
    if (found == drawing.joints.end() || !found->second)
      throw InputError(drawing.joints_file, "joints: has no \"" + name + "\"; training needs all");
    out.joints.push_back(skeleton.index(name));
    skeleton.joints[static_cast<std::size_t>(out.joints.back())].image = *found->second;
    placed[static_cast<std::size_t>(out.joints.back())] = true;
  }
  completeSkeleton(skeleton, placed, body_plan, silhouette);

  InflateOptions inflate_options;
  inflate_options.spacing_px = 2.5;
  inflate_options.max_texture_px = kPictureSize;
  out.character.mesh = inflate(image, silhouette, inflate_options);
  liftToModel(skeleton, out.character.mesh);
  out.character.weights = computeSkinWeights(out.character.mesh, skeleton, SkinMethod::kGeodesic);
  out.character.skeleton = std::move(skeleton);
  out.view = drawing.side_view ? FigureView::kSide : FigureView::kFront;
  const std::size_t count = out.character.skeleton.joints.size();
  out.deviations.assign(count, kTrunkTurn);
  out.limbs.assign(count, 0);
  for (std::size_t k = 0; k < body_plan.limbs.size(); ++k) {
    for (const int j : body_plan.limbs[k].joints) {
      out.limbs[static_cast<std::size_t>(j)] = static_cast<int>(k) + 1;
      out.deviations[static_cast<std::size_t>(j)] =
          body_plan.limbs[k].limb_class == JointClass::kHand ? kArmTurn : kLegTurn;
    }
  }
  return out;
}

// `shift_m`: of each joint, towards the viewer.
AnnotatedDrawing drawn(const PosableDrawing& drawing, const JointTransforms& posed_from_rest,
                       const std::vector<float>& shift_m) {
  const RiggedCharacter& character = drawing.character;
  Eigen::MatrixX3f vertices = skinVertices(character.mesh.vertices, character.weights, posed_from_rest);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    for (int k = 0; k < 4; ++k)
      vertices(v, 2) += character.weights.weights(v, k) * shift_m[character.weights.joints(v, k)];
  }
  Camera camera;
  const Eigen::Vector3f low = vertices.colwise().minCoeff(), high = vertices.colwise().maxCoeff();
  camera.target = ((low + high) / 2).cast<double>();
  camera.view_height_m = 1.02 * std::max(high.x() - low.x(), high.y() - low.y());
  camera.distance_m = 1e4;  // as good as without perspective
  RenderOptions options;
  options.width = options.height = kPictureSize;
  options.samples = 1;
  options.shading = 0;
  Image picture = renderMesh(vertices, character.mesh, camera, options);
  Plane8 mask(kPictureSize, kPictureSize);
  for (Eigen::Index i = 0; i < mask.size(); ++i) mask.data()[i] = picture.rgba(i, 3) > 127 ? 255 : 0;

  const std::vector<Eigen::Vector3f> joints = posedJoints(character.skeleton, posed_from_rest);
  std::vector<Eigen::Vector2d> places;
  for (const int j : drawing.joints) {
    const Eigen::Vector3d p = joints[static_cast<std::size_t>(j)].cast<double>() - camera.target;
    const double px_a_m = kPictureSize / camera.view_height_m;
    places.emplace_back(kPictureSize / 2.0 - .5 + px_a_m * p.x(), kPictureSize / 2.0 - .5 - px_a_m * p.y());
  }
  return annotatedDrawing(picture, mask, places, drawing.view);
}

}  // namespace

std::vector<PosableDrawing> posableDrawings(const std::vector<JointedDrawing>& drawings,
                                            const std::vector<std::string>& names,
                                            const SkeletonTemplate& body_plan, int threads) {
  std::vector<PosableDrawing> out(drawings.size());
  parallelFor(drawings.size(), threads,
              [&](std::size_t i) { out[i] = posable(drawings[i], names, body_plan); });
  return out;
}

AnnotatedDrawing asDrawn(const PosableDrawing& drawing) {
  const std::size_t count = drawing.character.skeleton.joints.size();
  return drawn(drawing,
               posedFromRest(drawing.character.skeleton,
                             std::vector<Eigen::Quaternionf>(count, Eigen::Quaternionf::Identity())),
               std::vector<float>(count, 0.f));
}

AnnotatedDrawing posed(Rng& rng, const PosableDrawing& drawing) {
  const Skeleton& skeleton = drawing.character.skeleton;
  std::vector<Eigen::Quaternionf> rotations(skeleton.joints.size(), Eigen::Quaternionf::Identity());
  std::vector<float> layers(1, 0.f), shift_m(skeleton.joints.size(), 0.f);
  for (int k = 1; k <= *std::max_element(drawing.limbs.begin(), drawing.limbs.end()); ++k)
    layers.push_back(static_cast<float>(kLayer_m * (rng.chance(.7) ? 1 : -1)));
  const double liveliness = rng.uniform(.2, 1.3);
  for (std::size_t j = 1; j < skeleton.joints.size(); ++j) {
    const double angle = std::clamp(rng.normal(), -2., 2.) * liveliness * drawing.deviations[j];
    rotations[j] = Eigen::AngleAxisf(static_cast<float>(angle), Eigen::Vector3f::UnitZ());
    shift_m[j] = layers[static_cast<std::size_t>(drawing.limbs[j])];
  }
  return drawn(drawing, posedFromRest(skeleton, rotations), shift_m);
}

}  // namespace skel
