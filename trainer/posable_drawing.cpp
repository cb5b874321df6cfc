#include "trainer/posable_drawing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libskel/core/error.h"
#include "libskel/core/parallel.h"
#include "libskel/core/progress.h"
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
constexpr double kLayer_m = 0.25;   // arms and legs before the body or behind it
constexpr int kLeastVertices = 20;  // of a limb that is given to another drawing
constexpr int kPictureSize = 400;   // px of the rendered drawing, before its box is cut out

// Maybe what is missing by another name.
std::string butUnknown(const JointedDrawing& drawing, const SkeletonTemplate& body_plan) {
  for (const auto& [name, place] : drawing.joints)
    if (body_plan.find(name) < 0)
      return ", but \"" + name + "\", which is no joint of the template " + body_plan.name;
  return "";
}

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
    if (found == drawing.joints.end())
      throw InputError(drawing.joints_file, "joints: has no \"" + name + "\"" +
                                                butUnknown(drawing, body_plan) +
                                                "; training needs all, null where one cannot be seen");
    out.joints.push_back(skeleton.index(name));
    out.unknown.push_back(!found->second);
    if (!found->second) continue;
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

// A drawing in a pose.
struct PosedDrawing {
  Eigen::MatrixX3f vertices;
  std::vector<Eigen::Vector3f> joints;  // of the skeleton
};

// `shift_m`: of each joint, towards the viewer.
PosedDrawing pose(const PosableDrawing& drawing, const JointTransforms& posed_from_rest,
                  const std::vector<float>& shift_m) {
  const RiggedCharacter& character = drawing.character;
  PosedDrawing out{skinVertices(character.mesh.vertices, character.weights, posed_from_rest),
                   posedJoints(character.skeleton, posed_from_rest)};
  for (Eigen::Index v = 0; v < out.vertices.rows(); ++v) {
    for (int k = 0; k < 4; ++k)
      out.vertices(v, 2) += character.weights.weights(v, k) * shift_m[character.weights.joints(v, k)];
  }
  return out;
}

PosedDrawing randomPose(Rng& rng, const PosableDrawing& drawing) {
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
  return pose(drawing, posedFromRest(skeleton, rotations), shift_m);
}

struct Frame {
  Eigen::Vector3f low = Eigen::Vector3f::Constant(1e9f), high = Eigen::Vector3f::Constant(-1e9f);
  void add(const Eigen::MatrixX3f& vertices, const TriangleMesh& mesh) {
    for (const int v : mesh.triangles.reshaped()) {
      low = low.cwiseMin(vertices.row(v).transpose());
      high = high.cwiseMax(vertices.row(v).transpose());
    }
  }
  // Without perspective, as good as.
  Camera camera() const {
    Camera camera;
    camera.target = ((low + high) / 2).cast<double>();
    camera.view_height_m = 1.02 * std::max(high.x() - low.x(), high.y() - low.y());
    camera.distance_m = 1e4;
    return camera;
  }
};

Image rendered(const Eigen::MatrixX3f& vertices, const TriangleMesh& mesh, const Camera& camera) {
  RenderOptions options;
  options.width = options.height = kPictureSize;
  options.samples = 1;
  options.shading = 0;
  options.ink = false;
  return renderMesh(vertices, mesh, camera, options);
}

// The joints of the net.
SmallDrawing annotated(const PosableDrawing& drawing, const Image& picture, const Camera& camera,
                       const std::vector<Eigen::Vector3f>& joints) {
  Plane8 mask(kPictureSize, kPictureSize);
  for (Eigen::Index i = 0; i < mask.size(); ++i) mask.data()[i] = picture.rgba(i, 3) > 127 ? 255 : 0;
  std::vector<Eigen::Vector2d> places;
  for (const int j : drawing.joints) {
    const Eigen::Vector3d p = joints[static_cast<std::size_t>(j)].cast<double>() - camera.target;
    const double px_a_m = kPictureSize / camera.view_height_m;
    places.emplace_back(kPictureSize / 2.0 - .5 + px_a_m * p.x(), kPictureSize / 2.0 - .5 - px_a_m * p.y());
  }
  SmallDrawing out = smallDrawing(picture, mask, places, drawing.view);
  out.unknown = drawing.unknown;
  return out;
}

SmallDrawing drawn(const PosableDrawing& drawing, const PosedDrawing& pose) {
  Frame frame;
  frame.add(pose.vertices, drawing.character.mesh);
  const Camera camera = frame.camera();
  return annotated(drawing, rendered(pose.vertices, drawing.character.mesh, camera), camera, pose.joints);
}

Eigen::Vector2d inModel(const PosableDrawing& drawing, int joint) {
  return drawing.character.skeleton.joints[static_cast<std::size_t>(joint)].position.head<2>();
}

// The joints of a limb, from the trunk outwards.
std::vector<int> chainOf(const PosableDrawing& drawing, int limb) {
  std::vector<int> chain;
  for (std::size_t j = 0; j < drawing.limbs.size(); ++j)
    if (drawing.limbs[j] == limb) chain.push_back(static_cast<int>(j));
  return chain;
}

double lengthOf(const PosableDrawing& drawing, const std::vector<int>& chain) {
  double length = 0;
  for (std::size_t k = 1; k < chain.size(); ++k)
    length += (inModel(drawing, chain[k]) - inModel(drawing, chain[k - 1])).norm();
  return length;
}

// Whether a limb is drawn beside the trunk, so that it can be taken off without a hole: its joints are known,
// lie farther from where it hangs than its root does, and from all other joints by a fifth of its length at
// least.
bool standsFree(const PosableDrawing& drawing, const std::vector<int>& chain) {
  const Skeleton& skeleton = drawing.character.skeleton;
  const int parent = skeleton.joints[static_cast<std::size_t>(chain.front())].parent;
  const Eigen::Vector2d from = inModel(drawing, parent), root = inModel(drawing, chain.front());
  const double apart = .2 * lengthOf(drawing, chain);
  for (std::size_t j = 0; j < drawing.joints.size(); ++j)
    if (drawing.unknown[j] && std::find(chain.begin(), chain.end(), drawing.joints[j]) != chain.end())
      return false;
  for (std::size_t k = 1; k < chain.size(); ++k) {
    const Eigen::Vector2d at = inModel(drawing, chain[k]);
    if ((at - from).norm() < 1.1 * (root - from).norm()) return false;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
      const int limb = drawing.limbs[j];
      if (limb == drawing.limbs[static_cast<std::size_t>(chain.front())]) continue;
      if ((at - inModel(drawing, static_cast<int>(j))).norm() < apart) return false;
    }
  }
  return true;
}

// Of each vertex the limb to which it belongs, 0: none.
std::vector<int> limbsOfVertices(const PosableDrawing& drawing) {
  const SkinWeights& skin = drawing.character.weights;
  std::vector<int> limbs(static_cast<std::size_t>(skin.weights.rows()), 0);
  for (Eigen::Index v = 0; v < skin.weights.rows(); ++v) {
    std::vector<float> share(drawing.joints.size() + 1, 0.f);
    for (int k = 0; k < 4; ++k)
      share[static_cast<std::size_t>(drawing.limbs[static_cast<std::size_t>(skin.joints(v, k))])] +=
          skin.weights(v, k);
    const auto most = std::max_element(share.begin(), share.end());
    if (*most > .5f) limbs[static_cast<std::size_t>(v)] = static_cast<int>(most - share.begin());
  }
  return limbs;
}

// The triangles that have all corners in `kept`.
TriangleMesh partOf(const TriangleMesh& mesh, const std::vector<bool>& kept) {
  TriangleMesh part = mesh;
  Eigen::Index count = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    if (t == mesh.first_back) part.first_back = count;
    if (kept[static_cast<std::size_t>(mesh.triangles(t, 0))] &&
        kept[static_cast<std::size_t>(mesh.triangles(t, 1))] &&
        kept[static_cast<std::size_t>(mesh.triangles(t, 2))])
      part.triangles.row(count++) = mesh.triangles.row(t);
  }
  part.triangles.conservativeResize(count, Eigen::NoChange);
  return part;
}

// `front` over `back`.
Image over(const Image& front, const Image& back) {
  Image out = back;
  for (Eigen::Index i = 0; i < front.rgba.rows(); ++i)
    if (front.rgba(i, 3) > 127) out.rgba.row(i) = front.rgba.row(i);
  return out;
}

}  // namespace

std::vector<PosableDrawing> posableDrawings(const std::vector<JointedDrawing>& drawings,
                                            const std::vector<std::string>& names,
                                            const SkeletonTemplate& body_plan, int threads) {
  std::vector<PosableDrawing> out(drawings.size());
  ProgressBar bar("preparing drawings", drawings.size());
  parallelFor(drawings.size(), threads, [&](std::size_t i) {
    out[i] = posable(drawings[i], names, body_plan);
    bar.advance();
  });
  return out;
}

SmallDrawing asDrawn(const PosableDrawing& drawing) {
  const std::size_t count = drawing.character.skeleton.joints.size();
  return drawn(drawing,
               pose(drawing,
                    posedFromRest(drawing.character.skeleton,
                                  std::vector<Eigen::Quaternionf>(count, Eigen::Quaternionf::Identity())),
                    std::vector<float>(count, 0.f)));
}

SmallDrawing posed(Rng& rng, const PosableDrawing& drawing) {
  return drawn(drawing, randomPose(rng, drawing));
}

SmallDrawing withLimbsOf(Rng& rng, const PosableDrawing& drawing, const PosableDrawing& donor) {
  PosedDrawing own = randomPose(rng, drawing);
  if (drawing.view != donor.view) return drawn(drawing, own);
  const PosedDrawing other = randomPose(rng, donor);
  const std::vector<int> own_limbs = limbsOfVertices(drawing), other_limbs = limbsOfVertices(donor);
  std::vector<bool> kept(own_limbs.size(), true), taken(other_limbs.size(), false);
  Eigen::MatrixX3f moved = other.vertices;
  bool any = false;
  for (int limb = 1; limb <= *std::max_element(drawing.limbs.begin(), drawing.limbs.end()); ++limb) {
    const std::vector<int> own_chain = chainOf(drawing, limb), other_chain = chainOf(donor, limb);
    const bool wanted = rng.chance(.6);
    const double own_length = lengthOf(drawing, own_chain) * std::exp(rng.normal(0, .2)),
                 other_length = lengthOf(donor, other_chain);
    if (!wanted || !standsFree(drawing, own_chain) || !standsFree(donor, other_chain)) continue;
    if (!(own_length > .4 * other_length && own_length < 2.5 * other_length)) continue;
    if (std::count(other_limbs.begin(), other_limbs.end(), limb) < kLeastVertices) continue;
    any = true;
    const auto scale = static_cast<float>(own_length / other_length);
    const auto move = [&](const Eigen::Vector3f& p) -> Eigen::Vector3f {
      const auto root_of = [](const PosedDrawing& pose, const std::vector<int>& chain) {
        return pose.joints[static_cast<std::size_t>(chain.front())];
      };
      return scale * (p - root_of(other, other_chain)) + root_of(own, own_chain);
    };
    for (std::size_t v = 0; v < own_limbs.size(); ++v)
      if (own_limbs[v] == limb) kept[v] = false;
    for (std::size_t v = 0; v < other_limbs.size(); ++v) {
      if (other_limbs[v] != limb) continue;
      taken[v] = true;
      moved.row(static_cast<Eigen::Index>(v)) =
          move(other.vertices.row(static_cast<Eigen::Index>(v)).transpose()).transpose();
    }
    for (std::size_t k = 1; k < own_chain.size(); ++k)
      own.joints[static_cast<std::size_t>(own_chain[k])] =
          move(other.joints[static_cast<std::size_t>(other_chain[k])]);
  }
  if (!any) return drawn(drawing, own);
  const TriangleMesh rest = partOf(drawing.character.mesh, kept), limbs = partOf(donor.character.mesh, taken);
  Frame frame;
  frame.add(own.vertices, rest);
  frame.add(moved, limbs);
  const Camera camera = frame.camera();
  const Image trunk = rendered(own.vertices, rest, camera), added = rendered(moved, limbs, camera);
  return annotated(drawing, rng.chance(.6) ? over(added, trunk) : over(trunk, added), camera, own.joints);
}

}  // namespace skel
