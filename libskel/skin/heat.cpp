// Bone heat: I. Baran, J. Popović, "Automatic rigging and animation of 3D characters" (2007), section 4. A
// vertex takes on the heat of its nearest bones as far as it sees them through the body, H = 1 / d², and
// spreads it along the surface: (−Δ + H) w = H p. Here "sees" asks the cubes of solid.h, so that neither
// holes nor faces that look inwards matter, and vertices at the same place are one, so that seams do not
// either.
//
// The surface's −Δ is the cotangent matrix over the vertices' areas (M. Meyer et al. 2003), and the system is
// multiplied by the areas: symmetric, positive definite in each part of the mesh where a vertex sees a bone,
// factorised once for all bones.
#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "libskel/core/error.h"
#include "libskel/core/segment.h"
#include "libskel/skin/methods.h"
#include "libskel/skin/parts.h"
#include "libskel/skin/solid.h"
#include "libskel/skin/welding.h"

namespace skel {
namespace {

constexpr double kEqually = 1.0001;           // near: two bones that differ by less both heat a vertex
constexpr int kMostEqual = 32;                // bones so near to one vertex: more lie at one place
constexpr double kLeast = 1e-3, kMost = 1e3;  // of a cotangent: slivers neither part nor tie the surface

using Matrix = Eigen::SparseMatrix<double>;

// Of the factorisation, in multiplications: some seconds. A surface of as many vertices as heat is for needs
// 7e9; what hangs together across all of space as many as the cube of its vertices.
constexpr double kMostWork = 1e10;

class Factor : public Eigen::SimplicialLDLT<Matrix> {
 public:
  // After analyzePattern().
  double work() const { return m_nonZerosPerCol.cast<double>().squaredNorm(); }
};

double cotangent(const Eigen::Vector3d& apex, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d u = a - apex, v = b - apex;
  const double sine = u.cross(v).norm(), cosine = u.dot(v);
  return sine > 0 ? std::clamp(cosine / sine, kLeast, kMost) : kLeast;
}

}  // namespace

JointWeights heatWeights(const SkinInput& input) {
  const TriangleMesh& mesh = input.mesh;
  const Welding welding(mesh.vertices);
  const int places = welding.count();
  const Solid solid(mesh);

  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd area = Eigen::VectorXd::Zero(places);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    std::array<int, 3> at{};
    std::array<Eigen::Vector3d, 3> p;
    for (int k = 0; k < 3; ++k) {
      at[k] = welding.place(mesh.triangles(t, k));
      p[k] = mesh.vertices.row(mesh.triangles(t, k)).cast<double>();
    }
    const double third = (p[1] - p[0]).cross(p[2] - p[0]).norm() / 6;
    for (int k = 0; k < 3; ++k) {
      area[at[k]] += third;
      const int a = at[(k + 1) % 3], b = at[(k + 2) % 3];
      if (a == b) continue;
      const double weight = 0.5 * cotangent(p[k], p[(k + 1) % 3], p[(k + 2) % 3]);
      entries.emplace_back(a, b, -weight);
      entries.emplace_back(b, a, -weight);
      entries.emplace_back(a, a, weight);
      entries.emplace_back(b, b, weight);
    }
  }

  // Which joints heat each place, and how much in all.
  const int joints = input.jointCount();
  const double least_area = std::max(1e-12, 1e-6 * area.mean());
  std::vector<std::vector<int>> heated(static_cast<std::size_t>(joints));  // places by joint
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(places);                    // for each of the joints
  std::vector<std::vector<int>> heaters(static_cast<std::size_t>(places));
  // In a part of the mesh where nothing sees a bone, every vertex is heated by its nearest one.
  const MeshParts parts = meshParts(mesh, welding);
  std::vector<char> sighted(static_cast<std::size_t>(parts.count), 0);
  std::vector<std::vector<int>> unseen(static_cast<std::size_t>(places));
  std::vector<double> distances(input.bones.size());
  std::vector<Eigen::Vector3f> feet(input.bones.size());
  for (int i = 0; i < places; ++i) {
    const Eigen::Vector3f p = mesh.vertices.row(welding.vertex(i));
    for (std::size_t b = 0; b < input.bones.size(); ++b) {
      feet[b] = nearestOnSegment<Eigen::Vector3f>(p, input.bones[b].from, input.bones[b].to);
      distances[b] = static_cast<double>((feet[b] - p).norm());
    }
    const double near = std::max(*std::min_element(distances.begin(), distances.end()), 1e-3);
    heat[i] = std::max(area[i], least_area) / (near * near);
    int equal = 0;
    for (std::size_t b = 0; b < input.bones.size(); ++b) {
      if (distances[b] > kEqually * near) continue;
      if (++equal > kMostEqual) break;
      const int joint = input.bones[b].joint;
      std::vector<int>& mine = solid.sees(p, feet[b]) ? heaters[i] : unseen[i];
      if (std::find(mine.begin(), mine.end(), joint) == mine.end()) mine.push_back(joint);
    }
    if (!heaters[i].empty()) sighted[parts.of_vertex[welding.vertex(i)]] = 1;
  }
  for (int i = 0; i < places; ++i) {
    if (!sighted[parts.of_vertex[welding.vertex(i)]]) heaters[i] = unseen[i];
    for (const int joint : heaters[i]) heated[joint].push_back(i);
    entries.emplace_back(i, i, static_cast<double>(heaters[i].size()) * heat[i] + 1e-12 * least_area);
  }
  Matrix system(places, places);
  system.setFromTriplets(entries.begin(), entries.end());
  Factor solver;
  solver.analyzePattern(system);
  if (solver.work() > kMostWork)
    throw InputError(input.options.file,
                     "has triangles that are no surface over which heat could spread in time; take the skin "
                     "method geodesic (--skin)");
  solver.factorize(system);
  JointWeights weights = JointWeights::Zero(mesh.vertices.rows(), joints);
  if (solver.info() != Eigen::Success) return weights;
  for (int joint = 0; joint < joints; ++joint) {
    if (heated[joint].empty()) continue;
    Eigen::VectorXd given = Eigen::VectorXd::Zero(places);
    for (const int i : heated[joint]) given[i] = heat[i];
    const Eigen::VectorXd solution = solver.solve(given);
    for (Eigen::Index v = 0; v < weights.rows(); ++v) {
      const double weight = solution[welding.place(static_cast<int>(v))];
      // Less than this is what is left of heat that came through nothing.
      weights(v, joint) = weight > 1e-4 ? static_cast<float>(std::min(weight, 1.0)) : 0;
    }
  }
  return weights;
}

}  // namespace skel
