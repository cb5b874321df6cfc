#include "libskel/deform/bound_stretch.h"

#include <algorithm>

#include "libskel/animation/sample_pose.h"
#include "libskel/deform/skin_vertices.h"
#include "libskel/deform/stretch.h"
#include "libskel/skin/bones.h"
#include "libskel/skin/edges.h"
#include "libskel/skin/smooth.h"

namespace skel {
namespace {

using Eigen::Index;
using Eigen::RowVector3f;

constexpr int kCandidateMoments = 16;  // of each clip, to choose from
constexpr std::size_t kTelling = 56;   // of all clips
constexpr float kAlike = 0.02f;        // squared, of turns: 6°; nearer moments stretch alike
constexpr int kSweeps = 4;             // of smoothing between two looks at what is stretched
constexpr int kRounds = 60;            // of such looks
constexpr int kWiden = 5;              // after so many rounds, what moves reaches an edge farther
constexpr int kPatience = 4;           // so many rounds without progress
constexpr float kTorn = 0.011f;        // of all triangles, that a limb may stretch
constexpr std::size_t kFew = 60;       // triangles that may ride rigidly without being seen
constexpr double kSpare =
    0.9;  // of the bound: between the moments that are looked at it may be a little more
constexpr float kSame = 0.05f;     // weights that differ by less, in sum, stretch nothing but slivers
constexpr float kSliver = 0.001f;  // and not even those
constexpr int kSliverRounds = 20;  // of evening them out

// Numbers at each moment, a row for each of some quantities; the last moment is repeated, so that rows are
// whole lanes.
using MomentRows = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
constexpr Index kLanes = 8;
using Lanes = Eigen::Array<float, kLanes, 1>;

Lanes lanesAt(const float* row) { return Eigen::Map<const Lanes>(row); }

// So many moments of all clips as differ most, each from those before it: first the one farthest from the
// rest pose. Far is by the joint whose turn differs most.
std::vector<JointTransforms> tellingMoments(const TriangleMesh& mesh, const Skeleton& skeleton,
                                            const std::vector<Clip>& clips) {
  const float height_m = mesh.vertices.col(1).maxCoeff() - mesh.vertices.col(1).minCoeff();
  std::vector<JointTransforms> all;
  for (const Clip& clip : clips)
    for (int k = 0; k < kCandidateMoments; ++k) {
      const float time_s = clip.duration_s() * float(k) / kCandidateMoments;
      all.push_back(posedFromRest(skeleton, samplePose(clip, skeleton, time_s), height_m));
    }
  const JointTransforms rest(skeleton.joints.size(), Eigen::Affine3f::Identity());
  const auto apart = [](const JointTransforms& a, const JointTransforms& b) {
    float most = 0;
    for (std::size_t j = 0; j < a.size(); ++j)
      most = std::max(most, (a[j].linear() - b[j].linear()).squaredNorm());
    return most;
  };
  std::vector<float> nearest;
  for (const JointTransforms& moment : all) nearest.push_back(apart(moment, rest));
  std::vector<JointTransforms> chosen;
  while (chosen.size() < kTelling) {
    const std::size_t next = std::size_t(std::max_element(nearest.begin(), nearest.end()) - nearest.begin());
    if (nearest[next] < kAlike) break;
    chosen.push_back(all[next]);
    for (std::size_t i = 0; i < all.size(); ++i)
      nearest[i] = std::min(nearest[i], apart(all[i], chosen.back()));
  }
  return chosen;
}

// Of each joint, rows: the upper three rows of its matrix, number by number; columns: the moments.
std::vector<MomentRows> byJoint(const std::vector<JointTransforms>& moments, std::size_t joint_count) {
  const Index columns = (Index(moments.size()) + kLanes - 1) / kLanes * kLanes;
  std::vector<MomentRows> joints(joint_count, MomentRows(12, columns));
  for (Index m = 0; m < columns; ++m) {
    const JointTransforms& moment = moments[std::min(std::size_t(m), moments.size() - 1)];
    for (std::size_t j = 0; j < joint_count; ++j)
      for (int i = 0; i < 12; ++i) joints[j](i, m) = moment[j].matrix()(i / 4, i % 4);
  }
  return joints;
}

// What is stretched, looked at again only where weights have changed.
class Stretched {
 public:
  Stretched(const TriangleMesh& mesh, std::vector<MomentRows> joints)
      : mesh_(mesh), joints_(std::move(joints)), rest_(restTriangles(mesh)) {
    const std::size_t vertices = std::size_t(mesh.vertices.rows());
    posed_.resize(3 * Index(vertices), joints_[0].cols());
    is_posed_.assign(vertices, 0);
    strains_.assign(rest_.size(), Strain::kUnknown);
    first_.assign(vertices + 1, 0);
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
      for (int k = 0; k < 3; ++k) ++first_[std::size_t(mesh.triangles(t, k)) + 1];
    for (std::size_t v = 0; v < vertices; ++v) first_[v + 1] += first_[v];
    triangles_.resize(std::size_t(first_.back()));
    std::vector<int> next(first_.begin(), first_.end() - 1);
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
      for (int k = 0; k < 3; ++k) triangles_[std::size_t(next[std::size_t(mesh.triangles(t, k))]++)] = int(t);
  }

  // Those that any moment stretches too far, ascending; of those whose weights differ by `same` at least.
  std::vector<int> all(const JointWeights& weights, float same = kSame) {
    std::vector<int> found;
    for (int t = 0; t < int(strains_.size()); ++t)
      if (isStretched(t, weights, same)) found.push_back(t);
    return found;
  }

  // The same of those at the vertices whose weights have changed.
  std::vector<int> among(const std::vector<int>& changed, const JointWeights& weights, float same = kSame) {
    std::vector<char> is_near(strains_.size(), 0);
    for (const int v : changed) {
      is_posed_[std::size_t(v)] = 0;
      for (int i = first_[std::size_t(v)]; i < first_[std::size_t(v) + 1]; ++i) {
        const auto t = std::size_t(triangles_[std::size_t(i)]);
        is_near[t] = 1, strains_[t] = Strain::kUnknown;
      }
    }
    std::vector<int> found;
    for (int t = 0; t < int(is_near.size()); ++t)
      if (is_near[std::size_t(t)] && isStretched(t, weights, same)) found.push_back(t);
    return found;
  }

 private:
  enum class Strain : char { kUnknown, kBorne, kTooFar };

  bool isStretched(int t, const JointWeights& weights, float same) {
    Strain& strain = strains_[std::size_t(t)];
    if (strain == Strain::kBorne || isRigid(t, weights, same)) return false;
    if (strain == Strain::kUnknown) {
      for (int k = 0; k < 3; ++k)
        if (char& posed = is_posed_[std::size_t(mesh_.triangles(t, k))]; !posed)
          posed = 1, pose(mesh_.triangles(t, k), weights);
      strain = tears(t) ? Strain::kTooFar : Strain::kBorne;
    }
    return strain == Strain::kTooFar;
  }

  bool isRigid(int t, const JointWeights& weights, float same) const {
    const auto a = weights.row(mesh_.triangles(t, 0)), b = weights.row(mesh_.triangles(t, 1)),
               c = weights.row(mesh_.triangles(t, 2));
    return (a - b).cwiseAbs().sum() < same && (a - c).cwiseAbs().sum() < same;
  }

  void pose(int v, const JointWeights& weights) {
    carriers_.clear();
    for (Index j = 0; j < weights.cols(); ++j)
      if (const float w = weights(v, j); w > 0)
        carriers_.push_back({joints_[std::size_t(j)].data(), w * mesh_.vertices.row(v), w});
    const Index columns = posed_.cols();
    for (int i = 0; i < 3; ++i)
      for (Index m = 0; m < columns; m += kLanes) {
        Lanes sum = Lanes::Zero();
        for (const Carrier& c : carriers_) {
          const float* row = c.matrix + 4 * i * columns + m;
          sum += c.at.x() * lanesAt(row) + c.at.y() * lanesAt(row + columns) +
                 c.at.z() * lanesAt(row + 2 * columns) + c.weight * lanesAt(row + 3 * columns);
        }
        Eigen::Map<Lanes>(&posed_(3 * v + i, m)) = sum;
      }
  }

  // The largest singular value of J is above b exactly if b² − JᵀJ is not positive definite.
  bool tears(int t) const {
    const RestTriangle& rest = rest_[std::size_t(t)];
    if (rest.inverse.isZero(0)) return false;
    const Eigen::Matrix2f inverse = rest.inverse.cast<float>();
    const float p = inverse(0, 0), q = inverse(0, 1), s = inverse(1, 1);  // below the diagonal there is zero
    constexpr float kMost2 = float(kSpare * kMostStretch * kSpare * kMostStretch);
    const Index columns = posed_.cols();
    const float* corner[3];
    for (int k = 0; k < 3; ++k) corner[k] = posed_.data() + 3 * mesh_.triangles(t, k) * columns;
    Lanes least = Lanes::Constant(kMost2);
    for (Index m = 0; m < columns; m += kLanes) {
      Lanes uu = Lanes::Zero(), uv = uu, vv = uu;
      for (int i = 0; i < 3; ++i) {
        const Lanes from = lanesAt(corner[0] + i * columns + m);
        const Lanes u = lanesAt(corner[1] + i * columns + m) - from,
                    v = lanesAt(corner[2] + i * columns + m) - from;
        uu += u * u, uv += u * v, vv += v * v;
      }
      const Lanes a = kMost2 - p * p * uu, b = p * (q * uu + s * uv),
                  c = kMost2 - (q * q * uu + 2 * q * s * uv + s * s * vv);
      least = least.min(a).min(a * c - b * b);
    }
    return least.minCoeff() <= 0;
  }

  // What has part in a vertex.
  struct Carrier {
    const float* matrix;  // of joints_
    RowVector3f at;       // the vertex by the weight
    float weight;
  };

  const TriangleMesh& mesh_;
  std::vector<MomentRows> joints_;
  std::vector<RestTriangle> rest_;
  MomentRows posed_;                    // three rows a vertex
  std::vector<char> is_posed_;          // as its weights are now
  std::vector<Strain> strains_;         // of triangles, so far as known
  std::vector<int> first_, triangles_;  // of each vertex
  std::vector<Carrier> carriers_;
};

// The four heaviest, with the sum 1.
void keepFour(Eigen::Ref<Eigen::RowVectorXf> row) {
  int count = int((row.array() > 0).count());
  for (; count > 4; --count) {
    Index least = -1;
    for (Index j = 0; j < row.size(); ++j)
      if (row[j] > 0 && (least < 0 || row[j] <= row[least])) least = j;
    row[least] = 0;
  }
  row = (row.array() < 1e-3f).select(0, row);
  row /= row.sum();
}

// The triangles' vertices and those up to so many edges away, ascending.
std::vector<int> around(const TriangleMesh& mesh, const Edges& edges, const std::vector<int>& triangles,
                        int rings) {
  std::vector<char> seen(std::size_t(mesh.vertices.rows()), 0);
  std::vector<int> vertices;
  const auto add = [&](int v) {
    if (!seen[std::size_t(v)]) seen[std::size_t(v)] = 1, vertices.push_back(v);
  };
  for (const int t : triangles)
    for (int k = 0; k < 3; ++k) add(mesh.triangles(t, k));
  for (std::size_t begin = 0; rings > 0; --rings) {
    const std::size_t end = vertices.size();
    for (; begin < end; ++begin) {
      const std::size_t v = std::size_t(vertices[begin]);
      for (int i = edges.first[v]; i < edges.first[v + 1]; ++i) add(edges.to[std::size_t(i)]);
    }
  }
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

// Most of the way to the mean of the neighbours, all at once.
void smoothRows(const Edges& edges, const std::vector<int>& vertices, JointWeights& rows) {
  JointWeights smooth(Index(vertices.size()), rows.cols());
  Eigen::RowVectorXf sum(rows.cols()), row(rows.cols());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const std::size_t v = std::size_t(vertices[i]);
    sum.setZero();
    const int begin = edges.first[v], end = edges.first[v + 1];
    for (int k = begin; k < end; ++k) sum += rows.row(edges.to[std::size_t(k)]);
    row = 0.25f * rows.row(Index(v)) + 0.75f / float(std::max(1, end - begin)) * sum;
    keepFour(row);
    smooth.row(Index(i)) = row;
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) rows.row(vertices[i]) = smooth.row(Index(i));
}

// The triangle rides rigidly.
void evenOut(const TriangleMesh& mesh, int triangle, JointWeights& rows) {
  Eigen::RowVectorXf mean = Eigen::RowVectorXf::Zero(rows.cols());
  for (int k = 0; k < 3; ++k) mean += rows.row(mesh.triangles(triangle, k));
  mean /= 3;
  keepFour(mean);
  for (int k = 0; k < 3; ++k) rows.row(mesh.triangles(triangle, k)) = mean;
}

// An arm rides with what it hangs on where it takes part in much of what is stretched in a body of the mesh,
// if it is one piece with the body (`joined`) or tears much of all. Returns the vertices that it moved,
// ascending.
std::vector<int> holdArms(const TriangleMesh& mesh, const Skeleton& skeleton, const std::vector<int>& limbs,
                          const std::vector<double>& joined, const std::vector<int>& stretched,
                          JointWeights& rows) {
  constexpr float kMuch = 0.1f;
  const float torn = 3 * kTorn * float(mesh.triangles.rows());  // corners
  std::vector<int> held;
  const auto layerOf = [&](int v) { return mesh.layer.size() > 0 ? mesh.layer[v] : 0; };
  for (int layer = 0; layer <= (mesh.layer.size() > 0 ? mesh.layer.maxCoeff() : 0); ++layer) {
    Eigen::RowVectorXf shares = Eigen::RowVectorXf::Zero(rows.cols());  // of limbs
    float all = 0;
    for (const int t : stretched)
      for (int k = 0; k < 3; ++k) {
        const int v = mesh.triangles(t, k);
        if (layerOf(v) != layer) continue;
        for (Index j = 0; j < rows.cols(); ++j) {
          if (const int limb = limbs[std::size_t(j)]; limb >= 0) shares[limb] += rows(v, j);
        }
        ++all;
      }
    for (int limb = 0; limb < int(rows.cols()); ++limb) {
      if (!skeleton.joints[std::size_t(limb)].name.ends_with("hand") ||
          (joined[std::size_t(limb)] < kGrownArm && shares[limb] < torn) || shares[limb] <= kMuch * all ||
          shares[limb] >= 0.99f * all)
        continue;
      int root = limb;
      while (limbs[std::size_t(skeleton.joints[std::size_t(root)].parent)] == limb)
        root = skeleton.joints[std::size_t(root)].parent;
      const int carrier = skeleton.joints[std::size_t(root)].parent;
      for (int v = 0; v < int(rows.rows()); ++v) {
        if (layerOf(v) != layer) continue;
        float moved = 0;
        for (int j = limb; j != carrier; j = skeleton.joints[std::size_t(j)].parent)
          moved += rows(v, j), rows(v, j) = 0;
        if (moved <= 0) continue;
        rows(v, carrier) += moved;
        held.push_back(v);
      }
    }
  }
  std::sort(held.begin(), held.end());
  held.erase(std::unique(held.begin(), held.end()), held.end());
  return held;
}

}  // namespace

StretchBound boundStretch(const TriangleMesh& mesh, const Skeleton& skeleton,
                          const std::vector<double>& joined, const std::vector<Clip>& clips,
                          SkinWeights& weights) {
  const int vertices = int(mesh.vertices.rows());
  if (vertices == 0 || clips.empty()) return {};
  JointWeights rows = unpackWeights(weights, int(skeleton.joints.size()));
  const std::vector<JointTransforms> moments = tellingMoments(mesh, skeleton, clips);
  if (moments.empty()) return {};
  Stretched stretched(mesh, byJoint(moments, skeleton.joints.size()));
  std::vector<int> found = stretched.all(rows);
  if (found.empty()) return {};
  const Edges edges = edgesOf(vertices, mesh.triangles);
  std::vector<char> changed(static_cast<std::size_t>(vertices), 0);
  const std::vector<int> limbs = jointLimbs(skeleton);
  std::size_t best = found.size();
  int stalled = 0;
  bool held_arms = false;
  for (int round = 0; round < kRounds && !found.empty(); ++round) {
    std::vector<int> moving = around(mesh, edges, found, 1 + round / kWiden);
    for (int sweep = 0; sweep < kSweeps; ++sweep) smoothRows(edges, moving, rows);
    // What is stretched lies at what has moved.
    found = stretched.among(moving, rows);
    for (const int v : moving) changed[std::size_t(v)] = 1;
    if (found.size() < kFew) {
      for (const int t : found) evenOut(mesh, t, rows);
      found = stretched.among(around(mesh, edges, found, 0), rows);
    }
    stalled = 20 * found.size() < 19 * best ? 0 : stalled + 1;
    best = std::min(best, found.size());
    if (stalled < kPatience || found.size() < kFew) continue;
    moving = holdArms(mesh, skeleton, limbs, joined, found, rows);
    if (moving.empty()) break;
    held_arms = true;
    for (const int v : moving) changed[std::size_t(v)] = 1;
    stretched.among(moving, rows);
    found = stretched.all(rows);
    best = found.size();
    stalled = 0;
  }
  found = stretched.all(rows, kSliver);
  for (int round = 0; round < kSliverRounds && !found.empty() && found.size() < kFew; ++round) {
    const std::vector<int> moving = around(mesh, edges, found, 0);
    for (const int t : found) evenOut(mesh, t, rows);
    for (const int v : moving) changed[std::size_t(v)] = 1;
    found = stretched.among(moving, rows, kSliver);
  }
  for (int v = 0; v < vertices; ++v)
    if (changed[std::size_t(v)]) packRow(rows, v, weights);
  return {int(found.size()), held_arms};
}

}  // namespace skel
