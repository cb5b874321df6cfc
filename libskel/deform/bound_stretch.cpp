#include "libskel/deform/bound_stretch.h"

#include <algorithm>
#include <array>
#include <cmath>

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
constexpr std::size_t kTelling = 96;   // of all clips
constexpr float kAlike = 0.01f;        // squared, of turns: 4°; nearer moments stretch alike
constexpr int kSweeps = 4;             // of diffusion between two looks at what is stretched
constexpr int kRounds = 120;           // of such looks
constexpr int kWiden = 5;              // after so many rounds, what moves reaches an edge farther
constexpr float kStiffen = 1.2f;       // edges of what is stretched, a round
constexpr float kStiffest = 1000;
constexpr float kUprooted = 0.45f;  // of an arm's weight, given or taken: it takes the body along
constexpr double kSpare =
    0.9;  // of the bound: between the moments that are looked at it may be a little more
constexpr float kSame = 0.05f;     // weights that differ by less, in sum, stretch nothing but slivers
constexpr float kSliver = 0.001f;  // and not even those

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
  std::vector<int> all(const JointWeights& weights, float same) {
    std::vector<int> found;
    for (int t = 0; t < int(strains_.size()); ++t)
      if (isStretched(t, weights, same)) found.push_back(t);
    return found;
  }

  // The same of those at the vertices whose weights have changed.
  std::vector<int> among(const std::vector<int>& changed, const JointWeights& weights, float same) {
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

// So many of the heaviest, each less the next one's weight (nearly: all may be alike), with the sum 1. Where
// a neighbour's order is another one, weights still are alike.
void limitInfluences(int count, Eigen::Ref<Eigen::RowVectorXf> row) {
  std::array<float, 5> weights{};  // descending
  std::array<Index, 5> joints{};
  for (Index j = 0; j < row.size(); ++j) {
    float weight = row[j];
    Index joint = j;
    for (std::size_t i = 0; i <= std::size_t(count) && weight > 0; ++i)
      if (weight > weights[i]) std::swap(weight, weights[i]), std::swap(joint, joints[i]);
  }
  const float less = 0.99f * weights[std::size_t(count)];
  float sum = 0;
  for (std::size_t i = 0; i < std::size_t(count); ++i)
    weights[i] = std::max(0.f, weights[i] - less), sum += weights[i];
  row.setZero();
  for (std::size_t i = 0; i < std::size_t(count); ++i)
    if (weights[i] >= 1e-3f * sum) row[joints[i]] = weights[i];
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

// Edges that pull a vertex towards its neighbours, in the order of Edges::to.
class Springs {
 public:
  explicit Springs(const Edges& edges) : edges_(edges), stiffness_(edges.to.size(), 1) {}

  void stiffen(const TriangleMesh& mesh, int triangle) {
    for (int k = 0; k < 3; ++k)
      for (const int step : {1, 2}) {
        const auto v = std::size_t(mesh.triangles(triangle, k));
        const auto end = edges_.to.begin() + edges_.first[v + 1];
        const auto at = std::lower_bound(edges_.to.begin() + edges_.first[v], end,
                                         mesh.triangles(triangle, (k + step) % 3));
        float& stiffness = stiffness_[std::size_t(at - edges_.to.begin())];
        stiffness = std::min(kStiffest, kStiffen * stiffness);
      }
  }

  // Most of the way to the mean of the neighbours, all vertices at once.
  void relax(const std::vector<int>& vertices, int max_influences, JointWeights& rows) const {
    JointWeights relaxed(Index(vertices.size()), rows.cols());
    Eigen::RowVectorXf pull(rows.cols());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const auto v = std::size_t(vertices[i]);
      pull.setZero();
      float all = 0;
      for (auto k = std::size_t(edges_.first[v]); k < std::size_t(edges_.first[v + 1]); ++k)
        pull += stiffness_[k] * rows.row(edges_.to[k]), all += stiffness_[k];
      pull = 0.25f * rows.row(Index(v)) + 0.75f / all * pull;
      limitInfluences(max_influences, pull);
      relaxed.row(Index(i)) = pull;
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) rows.row(vertices[i]) = relaxed.row(Index(i));
  }

 private:
  const Edges& edges_;
  std::vector<float> stiffness_;
};

int layerOf(const TriangleMesh& mesh, Index v) { return mesh.layer.size() > 0 ? mesh.layer[v] : 0; }

// From the hand up.
std::vector<int> jointsOf(const Skeleton& skeleton, int hand) {
  const std::vector<int> limbs = jointLimbs(skeleton);
  std::vector<int> joints;
  for (int joint = hand; joint >= 0 && limbs[std::size_t(joint)] == hand;
       joint = skeleton.joints[std::size_t(joint)].parent)
    joints.push_back(joint);
  return joints;
}

// What hangs on an arm in a body of the mesh.
class ArmShare {
 public:
  ArmShare(const TriangleMesh& mesh, const Skeleton& skeleton, const HeldArm& arm, const JointWeights& rows)
      : arm_(arm), joints_(jointsOf(skeleton, arm.hand)) {
    for (int v = 0; v < int(rows.rows()); ++v)
      if (layerOf(mesh, v) == arm.layer)
        vertices_.push_back(v), first_.push_back(at(v, rows)), all_ += first_.back();
  }

  const HeldArm& arm() const { return arm_; }

  bool isUprooted(const JointWeights& rows) const {
    float changed = 0;
    for (std::size_t i = 0; i < vertices_.size(); ++i)
      changed += std::abs(at(vertices_[i], rows) - first_[i]);
    return changed > kUprooted * all_;
  }

 private:
  float at(int v, const JointWeights& rows) const {
    float sum = 0;
    for (const int joint : joints_) sum += rows(v, joint);
    return sum;
  }

  HeldArm arm_;
  std::vector<int> joints_, vertices_;
  std::vector<float> first_;  // of vertices_
  float all_ = 0;
};

std::vector<ArmShare> armShares(const TriangleMesh& mesh, const Skeleton& skeleton,
                                const JointWeights& rows) {
  std::vector<ArmShare> shares;
  for (int joint = 0; joint < int(skeleton.joints.size()); ++joint)
    if (skeleton.joints[std::size_t(joint)].name.ends_with("hand"))
      for (int layer = 0; layer <= (mesh.layer.size() > 0 ? mesh.layer.maxCoeff() : 0); ++layer)
        shares.emplace_back(mesh, skeleton, HeldArm{joint, layer}, rows);
  return shares;
}

}  // namespace

StretchBound boundStretch(const TriangleMesh& mesh, const Skeleton& skeleton, const std::vector<Clip>& clips,
                          int max_influences, SkinWeights& weights) {
  const int vertices = int(mesh.vertices.rows());
  if (vertices == 0 || clips.empty() || max_influences < 2) return {};
  JointWeights rows = unpackWeights(weights, int(skeleton.joints.size()));
  const std::vector<JointTransforms> moments = tellingMoments(mesh, skeleton, clips);
  if (moments.empty()) return {};
  Stretched stretched(mesh, byJoint(moments, skeleton.joints.size()));
  float same = kSame;
  std::vector<int> found = stretched.all(rows, same);
  const Edges edges = edgesOf(vertices, mesh.triangles);
  Springs springs(edges);
  const std::vector<ArmShare> arms = armShares(mesh, skeleton, rows);
  std::vector<char> changed(std::size_t(vertices), 0);
  StretchBound bound;
  for (int round = 0; round < kRounds; ++round) {
    if (found.empty() && same > kSliver) found = stretched.all(rows, same = kSliver);
    if (found.empty()) break;
    for (const int t : found) springs.stiffen(mesh, t);
    const std::vector<int> moving = around(mesh, edges, found, 1 + round / kWiden);
    for (int sweep = 0; sweep < kSweeps; ++sweep) springs.relax(moving, max_influences, rows);
    for (const int v : moving) changed[std::size_t(v)] = 1;
    // What is stretched lies at what has moved.
    found = stretched.among(moving, rows, same);
    for (const ArmShare& share : arms)
      if (share.isUprooted(rows)) bound.uprooted.push_back(share.arm());
    if (!bound.uprooted.empty()) return bound;
  }
  for (int v = 0; v < vertices; ++v)
    if (changed[std::size_t(v)]) packRow(rows, v, weights);
  bound.stretched = int(found.size());
  return bound;
}

void holdArm(const TriangleMesh& mesh, const Skeleton& skeleton, const HeldArm& arm, SkinWeights& weights) {
  const std::vector<int> joints = jointsOf(skeleton, arm.hand);
  const int carrier = skeleton.joints[std::size_t(joints.back())].parent;
  JointWeights rows = unpackWeights(weights, int(skeleton.joints.size()));
  for (Index v = 0; v < rows.rows(); ++v) {
    if (layerOf(mesh, v) != arm.layer) continue;
    float moved = 0;
    for (const int joint : joints) moved += rows(v, joint), rows(v, joint) = 0;
    if (moved <= 0) continue;
    rows(v, carrier) += moved;
    packRow(rows, v, weights);
  }
}

}  // namespace skel
