#include "libskel/skin/skin_weights.h"

#include <algorithm>
#include <limits>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/skin/bones.h"
#include "libskel/skin/methods.h"
#include "libskel/skin/parts.h"
#include "libskel/skin/smooth.h"
#include "libskel/skin/soften.h"
#include "libskel/skin/vertex_tree.h"
#include "libskel/skin/welding.h"

namespace skel {
namespace {

struct Method {
  SkinMethod method;
  std::string_view name;
  SkinFunction* weights;
  bool soft;          // made to bend without creases (soften.h)
  bool parts_follow;  // parts of the mesh without a bone go with what they touch
  Eigen::Index most_vertices = std::numeric_limits<Eigen::Index>::max();
};
// Factorising the system of a surface takes time as n^1.5: 5 s for so many.
constexpr Eigen::Index kMostHeated = 200'000;
constexpr Method kMethods[] = {
    {SkinMethod::kGeodesic, "geodesic", geodesicWeights, true, true},
    {SkinMethod::kHeat, "heat", heatWeights, false, true, kMostHeated},
    {SkinMethod::kEuclidean, "euclidean", euclideanWeights, true, false},
    {SkinMethod::kIdw, "idw", idwWeights, false, false},
    {SkinMethod::kIdwRegion, "idw-region", idwRegionWeights, false, false},
};

const Method& find(SkinMethod method) {
  const auto* found = std::find_if(std::begin(kMethods), std::end(kMethods),
                                   [&](const Method& m) { return m.method == method; });
  SKEL_CHECK(found != std::end(kMethods));
  return *found;
}

constexpr int kSmoothing = 6;  // rounds, of weights that come by distance alone

// Rows of zeros become those of the nearest vertex that has weights.
void fillFromNearest(const Eigen::MatrixX3f& vertices, JointWeights& weights) {
  std::vector<int> empty;
  VertexTree known(vertices);
  for (int v = 0; v < vertices.rows(); ++v) {
    if (weights.row(v).maxCoeff() > 0)
      known.add(v);
    else
      empty.push_back(v);
  }
  for (const int v : empty) {
    const int nearest = known.nearest(vertices.row(v), std::numeric_limits<float>::infinity()).vertex;
    SKEL_CHECK(nearest >= 0);
    weights.row(v) = weights.row(nearest);
  }
}

// The parts of a mesh that have bones, with one vertex at each place.
struct Body {
  TriangleMesh mesh;
  std::vector<int> rows;  // of the whole mesh's vertices, -1: of another part

  Body(const TriangleMesh& whole, const Welding& welding, const MeshParts& parts,
       const std::vector<char>& with_bones) {
    std::vector<int> of_place(static_cast<std::size_t>(welding.count()), -1), vertices;
    for (int place = 0; place < welding.count(); ++place) {
      const int vertex = welding.vertex(place);
      if (!with_bones[static_cast<std::size_t>(parts.of_vertex[static_cast<std::size_t>(vertex)])]) continue;
      of_place[static_cast<std::size_t>(place)] = static_cast<int>(vertices.size());
      vertices.push_back(vertex);
    }
    for (int v = 0; v < whole.vertices.rows(); ++v)
      rows.push_back(of_place[static_cast<std::size_t>(welding.place(v))]);
    mesh.vertices = whole.vertices(vertices, Eigen::all);
    mesh.triangles.resize(whole.triangles.rows(), 3);
    Eigen::Index count = 0;
    for (Eigen::Index t = 0; t < whole.triangles.rows(); ++t) {
      Eigen::RowVector3i corners = whole.triangles.row(t);
      for (int& corner : corners) corner = rows[static_cast<std::size_t>(corner)];
      if (corners[0] < 0 || corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
        continue;
      mesh.triangles.row(count++) = corners;
    }
    mesh.triangles.conservativeResize(count, 3);
  }
};

// Rows that sum to 1, with at most so many weights as the options allow.
JointWeights bodyWeights(const TriangleMesh& mesh, const Skeleton& skeleton, const std::vector<Bone>& bones,
                         const Method& way, const SkinOptions& options) {
  JointWeights weights = way.weights({mesh, skeleton, bones, options});
  if (!(weights.maxCoeff() > 0))
    throw InputError(options.file,
                     "lies so far from all bones, for its size, that none reaches it by " +
                         std::string(way.name) +
                         "; look at the skeleton's unit, or take the skin method geodesic (--skin)");
  fillFromNearest(mesh.vertices, weights);
  // What is known of bends is known of drawings, whose limbs bend in their plane or out of it.
  const bool flat = nearlyFlat(bones);
  if (way.soft && flat) {
    softenWeights(mesh, skeleton, options.max_influences, weights);
  } else if (way.soft) {
    partLimbs(skeleton, jointLimbs(skeleton), weights);
    smoothWeights(mesh, kSmoothing, weights);
  }
  if (options.smoothing > 0) smoothWeights(mesh, options.smoothing, weights);
  if (!way.soft || !flat || options.smoothing > 0) keepHeaviest(options.max_influences, weights);
  return weights;
}

JointWeights meshWeights(const TriangleMesh& mesh, const Skeleton& skeleton, const std::vector<Bone>& bones,
                         const Method& way, const SkinOptions& options) {
  const Welding welding(mesh.vertices);
  const MeshParts parts = meshParts(mesh, welding);
  std::vector<char> with_bones(static_cast<std::size_t>(parts.count), 1);
  if (way.parts_follow && parts.count > 1) with_bones = partsWithBones(mesh, parts, bones);
  if (parts.count == 1 && welding.count() == mesh.vertices.rows())
    return bodyWeights(mesh, skeleton, bones, way, options);
  const Body body(mesh, welding, parts, with_bones);
  const JointWeights of_body = bodyWeights(body.mesh, skeleton, bones, way, options);
  JointWeights weights =
      JointWeights::Zero(mesh.vertices.rows(), static_cast<Eigen::Index>(skeleton.joints.size()));
  for (Eigen::Index v = 0; v < weights.rows(); ++v)
    if (const int row = body.rows[static_cast<std::size_t>(v)]; row >= 0) weights.row(v) = of_body.row(row);
  followTouchedParts(mesh, parts, with_bones, weights);
  return weights;
}

std::vector<Bone> bonesOfLayer(const std::vector<Bone>& bones, const std::vector<int>& joint_layers,
                               int layer) {
  std::vector<Bone> own;
  for (const Bone& bone : bones)
    if (joint_layers[static_cast<std::size_t>(bone.joint)] == layer) own.push_back(bone);
  SKEL_CHECK(!own.empty());
  return own;
}

// The bodies of the mesh one by one.
JointWeights layerWeights(const TriangleMesh& mesh, const Skeleton& skeleton, const std::vector<Bone>& bones,
                          const Method& way, const SkinOptions& options,
                          const std::vector<int>& joint_layers) {
  if (mesh.layer.size() == 0)
    return meshWeights(mesh, skeleton, bonesOfLayer(bones, joint_layers, 0), way, options);
  JointWeights weights =
      JointWeights::Zero(mesh.vertices.rows(), static_cast<Eigen::Index>(skeleton.joints.size()));
  for (int layer = 0; layer <= mesh.layer.maxCoeff(); ++layer) {
    std::vector<int> rows, number(static_cast<std::size_t>(mesh.vertices.rows()), -1);
    for (int v = 0; v < mesh.vertices.rows(); ++v) {
      if (mesh.layer[v] != layer) continue;
      number[static_cast<std::size_t>(v)] = static_cast<int>(rows.size());
      rows.push_back(v);
    }
    if (rows.empty()) continue;
    TriangleMesh piece;
    piece.vertices = mesh.vertices(rows, Eigen::all);
    piece.triangles.resize(mesh.triangles.rows(), 3);
    Eigen::Index count = 0;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
      if (mesh.layer[mesh.triangles(t, 0)] != layer) continue;
      for (int k = 0; k < 3; ++k)
        piece.triangles(count, k) = number[static_cast<std::size_t>(mesh.triangles(t, k))];
      ++count;
    }
    piece.triangles.conservativeResize(count, 3);
    weights(rows, Eigen::all) =
        meshWeights(piece, skeleton, bonesOfLayer(bones, joint_layers, layer), way, options);
  }
  return weights;
}

}  // namespace

std::vector<SkinMethod> skinMethods() {
  std::vector<SkinMethod> methods;
  for (const Method& method : kMethods) methods.push_back(method.method);
  return methods;
}

std::string_view skinMethodName(SkinMethod method) { return find(method).name; }

void checkBindable(const TriangleMesh& mesh, std::size_t joints, const std::string& file) {
  const auto check = [&](Eigen::Index count, std::int64_t most, const std::string& what) {
    most /= static_cast<std::int64_t>(joints);
    if (count > most)
      throw InputError(file, "has " + std::to_string(count) + " " + what + " for " + std::to_string(joints) +
                                 " joints; at most " + std::to_string(most) + " " + what +
                                 " can be bound to so many: take a coarser mesh or fewer joints");
  };
  check(mesh.vertices.rows(), kMostVertexJoints, "vertices");
  check(mesh.triangles.rows(), kMostTriangleJoints, "triangles");
}

SkinWeights computeSkinWeights(const TriangleMesh& mesh, const Skeleton& skeleton, SkinMethod method,
                               const SkinOptions& options, const std::vector<int>& joint_layers) {
  SKEL_CHECK(options.max_influences >= 1 && options.max_influences <= 4);
  SKEL_CHECK(!skeleton.joints.empty());
  if (mesh.vertices.rows() == 0) return {};
  SKEL_CHECK(mesh.vertices.allFinite());

  checkBindable(mesh, skeleton.joints.size(), options.file);
  const Method& way = find(method);
  if (mesh.vertices.rows() > way.most_vertices)
    throw UsageError("weights by " + std::string(way.name) + " are for at most " +
                     std::to_string(way.most_vertices) + " vertices, the model has " +
                     std::to_string(mesh.vertices.rows()) +
                     "; take the skin method geodesic (--skin), whose time grows as their number");
  const std::vector<Bone> bones = skeletonBones(skeleton);
  return packWeights(joint_layers.empty() ? meshWeights(mesh, skeleton, bones, way, options)
                                          : layerWeights(mesh, skeleton, bones, way, options, joint_layers));
}

bool carriesSkin(const Skeleton& skeleton, const SkinWeights& skin, int joint) {
  std::vector<bool> carried;  // by the joint
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const int parent = skeleton.joints[j].parent;
    carried.push_back(int(j) == joint || (parent >= 0 && carried[std::size_t(parent)]));
  }
  for (Eigen::Index v = 0; v < skin.joints.rows(); ++v)
    for (Eigen::Index k = 0; k < skin.joints.cols(); ++k)
      if (skin.weights(v, k) > 0 && carried[skin.joints(v, k)]) return true;
  return false;
}

}  // namespace skel
