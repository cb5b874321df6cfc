// Stage 8: which joints carry a vertex, and how much.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "libskel/mesh/triangle_mesh.h"
#include "libskel/skeleton/skeleton.h"
#include "libskel/skin/regions.h"

namespace skel {

// Four influences a vertex, heaviest first, weights sum to 1; unused ones are joint 0, weight 0.
struct SkinWeights {
  Eigen::Matrix<std::uint16_t, Eigen::Dynamic, 4, Eigen::RowMajor>
      joints;                                                        // #V×4, indices into Skeleton::joints
  Eigen::Matrix<float, Eigen::Dynamic, 4, Eigen::RowMajor> weights;  // #V×4
};

enum class SkinMethod {
  kGeodesic,   // by distance from the bone measured inside the body
  kHeat,       // bone heat, Baran & Popović (2007)
  kEuclidean,  // by distance through the air, for comparison
  kIdw,        // inverse distance to the 4 nearest bones
  kIdwRegion,  // the same, among regions of the body that may mix
};

// All of them, and their names on the command line.
std::vector<SkinMethod> skinMethods();
std::string_view skinMethodName(SkinMethod method);

struct SkinOptions {
  int max_influences = 4;  // 1…4
  // How often each vertex moves half way to the mean of its neighbours, at last; 0…1000.
  int smoothing = 0;
  std::shared_ptr<const SkinRegions> regions = {};  // of kIdwRegion; null: defaultRegions()
  std::string file = "the model";                   // that the mesh came from, as errors name it
};

// Vertices times joints: each pair has a few numbers while weights are computed.
inline constexpr std::int64_t kMostVertexJoints = 32'000'000;
// Triangles times joints: where a bone lies is asked of each triangle.
inline constexpr std::int64_t kMostTriangleJoints = 128'000'000;
// Throws InputError where there are more of these, or of those.
void checkBindable(const TriangleMesh& mesh, std::size_t joints, const std::string& file);

// A joint moves the segment from itself to its tail if it has one; else to its child, a leaf a short tip
// segment beyond it, and the head also the upper half of the segment that leads to it. Any mesh will do:
// open, in several parts, with several vertices at one place, its faces turned as they like. By kGeodesic and
// kHeat, a part without a bone in it follows one joint of the part that it touches (parts.h). Vertices that
// no bone reaches take the weights of the nearest one that is reached.
//
// Of a mesh in layers (TriangleMesh::layer), the vertices of each follow the bones of its own joints alone:
// `joint_layers`, one number a joint, each layer has one; empty: all follow all. A joint of layer -1 moves
// nothing.
//
// Throws InputError: more vertices times joints than kMostVertexJoints, triangles that are no surface
// (kHeat); UsageError: more vertices than the
// method is for (kHeat: 200,000).
SkinWeights computeSkinWeights(const TriangleMesh& mesh, const Skeleton& skeleton, SkinMethod method,
                               const SkinOptions& options = {}, const std::vector<int>& joint_layers = {});

// Whether any vertex follows the joint, or one that it carries.
bool carriesSkin(const Skeleton& skeleton, const SkinWeights& skin, int joint);

}  // namespace skel
