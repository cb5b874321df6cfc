// A joint bent by 90° moves a point at p from it to A·p with A = (1 − w)·I + w·R, w the weight of all that
// the joint moves, and the plane about it by A + D·∇wᵀ, D = (R − I)·p. That turns inside out where ∇w·A⁻¹D <
// −1. With J·p, p turned by 90°, A⁻¹D = ((2w − 1)·p ± J·p) / ((1 − w)² + w²). The angle by which the point
// turns, ψ = atan(w / (1 − w)), has ∇ψ = ∇w / ((1 − w)² + w²): bends to both sides are sound where |∇ψ across
// p| − (2w − 1)·(∇ψ along p) < 1 / |p|. Around the joint, then, ψ may change no faster than the direction to
// the joint: by |e across p| / |p| along an edge e. Straight away from the joint, more does no harm.
//
// Of all turns that nowhere change faster than allowed, the largest that is not above the given one is the
// given one's lower envelope, min over y of ψ(y) + way(x, y), a way being as long as the changes that it
// allows: Dijkstra's (1959) algorithm finds it in one go, however far the change has to spread. So too the
// smallest not below, and their mean keeps a joint's bend where it was.
#include "libskel/skin/soften.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <queue>
#include <vector>

#include "libskel/skin/bones.h"
#include "libskel/skin/edges.h"

namespace skel {
namespace {

constexpr float kLargestChange = 0.33f;  // along an edge
constexpr float kFineMesh = 0.04f;       // mean edge, of the mesh's size: coarse ones cannot but change much
constexpr float kBend = 0.9f;            // of what would turn a triangle inside out
constexpr float kAlong = 1.5f;           // how much of it, straight away from the joint, where less is needed
constexpr float kTighter = 0.7f;         // by how much the weights change less where a triangle did turn
constexpr float kClear = 0.01f;          // of a triangle's area: thinner than that, it counts as inside out
constexpr int kRounds = 16;              // of all limits in turn
constexpr int kTries = 40, kSweeps = 60;  // of smoothing and cutting, of smoothing

// A chain of more joints bends a little at each of them, which folds nothing.
constexpr std::size_t kMostOfLimb = 32;
// Each hinge looks at all vertices, several times: some seconds. A drawing's largest model has a quarter.
constexpr std::size_t kMostHingeVertices = 8'000'000;

// The joints each of which bends the middle of a limb.
struct Hinge {
  int joint;
  Eigen::RowVector3f position;
  std::vector<int> above, moved;  // joints of the limb: those it hangs on, and itself with those it moves
  std::vector<float> allowed;     // change of the turn, rad, by arc; negative: not known yet
};

std::vector<Hinge> hinges(const Skeleton& skeleton, const std::vector<int>& limbs) {
  const int count = static_cast<int>(skeleton.joints.size());
  std::vector<Hinge> result;
  std::vector<std::size_t> length(count, 0);  // joints of each limb
  for (int joint = 1; joint < count; ++joint)
    if (limbs[joint] >= 0) ++length[limbs[joint]];
  for (int joint = 1; joint < count; ++joint) {
    const int parent = skeleton.joints[joint].parent;
    if (limbs[joint] < 0 || limbs[joint] == joint || limbs[parent] != limbs[joint]) continue;
    if (length[limbs[joint]] > kMostOfLimb) continue;
    Hinge hinge{joint, skeleton.joints[joint].position.cast<float>().transpose(), {}, {}, {}};
    for (int other = 1; other < count; ++other) {
      if (limbs[other] == limbs[joint]) (other < joint ? hinge.above : hinge.moved).push_back(other);
    }
    result.push_back(std::move(hinge));
  }
  return result;
}

// How much the turn may change from v along the arc, rad.
float allowedChange(const TriangleMesh& mesh, const Edges& edges, Hinge& hinge, int v, int arc) {
  float& allowed = hinge.allowed[arc];
  if (allowed >= 0) return allowed;
  const Eigen::RowVector3f a = mesh.vertices.row(v), b = mesh.vertices.row(edges.to[arc]);
  const Eigen::RowVector3f arm = 0.5f * (a + b) - hinge.position, edge = b - a;
  const float arm2 = std::max(arm.squaredNorm(), 1e-12f), along = edge.dot(arm);
  const float along2 = along * along / arm2;
  const float across2 = std::max(0.0f, edge.squaredNorm() - along2);
  allowed = kBend * std::sqrt(std::max(across2, kAlong * kAlong * along2) / arm2);
  return allowed;
}

// Lowers values until none is above a neighbour's by more than allowed.
void lowerEnvelope(const TriangleMesh& mesh, const Edges& edges, Hinge& hinge, std::vector<float>& values) {
  using Front = std::pair<float, int>;
  std::priority_queue<Front, std::vector<Front>, std::greater<>> fronts;
  const auto spread = [&](int v) {
    for (int i = edges.first[v]; i < edges.first[v + 1]; ++i) {
      const int to = edges.to[i];
      if (values[to] <= values[v]) continue;
      const float limit = values[v] + allowedChange(mesh, edges, hinge, v, i);
      if (values[to] <= limit) continue;
      values[to] = limit;
      fronts.emplace(limit, to);
    }
  };
  for (int v = 0; v < static_cast<int>(values.size()); ++v) {
    for (int i = edges.first[v]; i < edges.first[v + 1]; ++i) {
      if (values[edges.to[i]] <= values[v] ||
          values[edges.to[i]] <= values[v] + allowedChange(mesh, edges, hinge, v, i))
        continue;
      fronts.emplace(values[v], v);
      break;
    }
  }
  while (!fronts.empty()) {
    const auto [value, v] = fronts.top();
    fronts.pop();
    if (value == values[v]) spread(v);
  }
}

void bendSoftly(const TriangleMesh& mesh, const Edges& edges, Hinge& hinge, JointWeights& weights) {
  const int vertices = static_cast<int>(weights.rows());
  std::vector<float> given(vertices), limb(vertices);
  for (int v = 0; v < vertices; ++v) {
    for (const int joint : hinge.moved) given[v] += weights(v, joint);
    limb[v] = given[v];
    for (const int joint : hinge.above) limb[v] += weights(v, joint);
  }
  // In doubles: rounded to floats, the sines of all C libraries are the same.
  const auto turn = [](float weight) {
    return weight == 0 ? 0.0f : float(std::atan2(double(weight), 1 - double(weight)));
  };
  std::vector<float> low(vertices), high(vertices);  // turns; high ones are negative
  for (int v = 0; v < vertices; ++v) low[v] = turn(given[v]), high[v] = -low[v];
  lowerEnvelope(mesh, edges, hinge, low);
  lowerEnvelope(mesh, edges, hinge, high);
  // Not more than the limb has: what it lies against is not drawn along.
  for (int v = 0; v < vertices; ++v) low[v] = 0.5f * (low[v] + std::min(-high[v], turn(limb[v])));
  lowerEnvelope(mesh, edges, hinge, low);
  for (int v = 0; v < vertices; ++v) {
    if (low[v] == 0 && given[v] == 0) continue;
    const double sine = std::sin(double(low[v])), cosine = std::cos(double(low[v]));
    const auto weight = float(sine / (sine + cosine));
    low[v] = std::abs(weight - given[v]) < 1e-5f ? given[v] : std::min(weight, limb[v]);
  }
  for (int v = 0; v < vertices; ++v) {
    const float change = low[v] - given[v];
    if (change < 0) {
      for (const int joint : hinge.moved) weights(v, joint) *= low[v] / given[v];
      weights(v, hinge.above.back()) -= change;
    } else if (change > 0) {
      for (const int joint : hinge.above)
        weights(v, joint) *= std::max(0.0f, limb[v] - low[v]) / (limb[v] - given[v]);
      weights(v, hinge.joint) += change;
    }
  }
}

// Where the hinge, bent by 90° to either side or out of the drawing's plane, turns triangles inside out, the
// weights about them may change less from now on. Returns whether there are such.
bool tighten(const TriangleMesh& mesh, const Skeleton& skeleton, const Edges& edges,
             const JointWeights& weights, Hinge& hinge) {
  const Eigen::Vector3f bone =
      (skeleton.joints[hinge.joint].position - skeleton.joints[skeleton.joints[hinge.joint].parent].position)
          .cast<float>();
  const Eigen::Vector3f out = bone.cross(Eigen::Vector3f::UnitZ()).stableNormalized();
  Eigen::Matrix3f turns[4];  // less the identity
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector3f axis = k < 2 ? Eigen::Vector3f(Eigen::Vector3f::UnitZ()) : out;
    const Eigen::AngleAxisf turn((k % 2 ? 0.5f : -0.5f) * std::numbers::pi_v<float>, axis);
    turns[k] = turn.toRotationMatrix() - Eigen::Matrix3f::Identity();
  }
  std::vector<float> moved(weights.rows());
  for (int v = 0; v < weights.rows(); ++v) {
    for (const int joint : hinge.moved) moved[v] += weights(v, joint);
  }
  std::vector<char> tight(weights.rows(), 0);
  bool any = false;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const Eigen::RowVector3i corners = mesh.triangles.row(t);
    const float w[3] = {moved[corners[0]], moved[corners[1]], moved[corners[2]]};
    const float change = std::max({w[0], w[1], w[2]}) - std::min({w[0], w[1], w[2]});
    if (change < 1e-4f) continue;
    Eigen::Vector3f p[3];
    for (int k = 0; k < 3; ++k) p[k] = (mesh.vertices.row(corners[k]) - hinge.position).transpose();
    const Eigen::Vector3f normal = (p[1] - p[0]).cross(p[2] - p[0]);
    if (normal.isZero(0)) continue;  // of a user's model: it has no side to turn
    // Far below what could: the weight's slope is at most its change over the triangle's least height,
    // 2·|∇w|·|p| at most what the top of this file has.
    const float side2 =
        std::max({(p[1] - p[0]).squaredNorm(), (p[2] - p[1]).squaredNorm(), (p[0] - p[2]).squaredNorm()});
    const float arm2 = std::max({p[0].squaredNorm(), p[1].squaredNorm(), p[2].squaredNorm()});
    if (4 * change * change * side2 * arm2 < 0.8f * normal.squaredNorm()) continue;
    const float mean = (w[0] + w[1] + w[2]) / 3;
    bool inside_out = false;
    for (const Eigen::Matrix3f& turn : turns) {
      const Eigen::Vector3f ta = turn * p[0], tb = turn * p[1], tc = turn * p[2], turned = turn * normal;
      const Eigen::Vector3f a = p[0] + w[0] * ta, b = p[1] + w[1] * tb, c = p[2] + w[2] * tc;
      inside_out =
          inside_out || (b - a).cross(c - a).dot(normal + mean * turned) <= kClear * normal.squaredNorm();
    }
    if (!inside_out) continue;
    any = true;
    for (int k = 0; k < 3; ++k) tight[corners[k]] = 1;
  }
  if (!any) return false;
  for (std::size_t v = 0; v < tight.size(); ++v) {
    for (int i = edges.first[v]; i < edges.first[v + 1]; ++i) {
      if (!tight[v] && !tight[edges.to[i]]) continue;
      hinge.allowed[i] = kTighter * allowedChange(mesh, edges, hinge, static_cast<int>(v), i);
    }
  }
  return true;
}

// The rows at the ends of an edge come nearer to each other until no edge sees too large a change. `waiting`:
// where to begin; becomes the vertices whose rows changed, ascending.
void smoothEdges(const Edges& edges, std::vector<int>& waiting, JointWeights& weights) {
  std::vector<int> later, changed, queued(weights.rows(), -1);
  for (const int v : waiting) queued[v] = 0;
  for (int sweep = 1; sweep <= kSweeps && !waiting.empty(); ++sweep) {
    later.clear();
    for (const int v : waiting) {
      for (int i = edges.first[v]; i < edges.first[v + 1]; ++i) {
        const int to = edges.to[i];
        if (to < v && queued[to] >= sweep - 1) continue;  // seen from there
        auto a = weights.row(v), b = weights.row(to);
        const float change = (a - b).cwiseAbs().maxCoeff();
        if (change <= kLargestChange) continue;
        const float share = 0.5f * (1 - 0.97f * kLargestChange / change);
        for (Eigen::Index j = 0; j < a.size(); ++j) {
          const float step = share * (b[j] - a[j]);
          a[j] += step, b[j] -= step;
        }
        for (const int end : {v, to}) {
          if (queued[end] != sweep) queued[end] = sweep, later.push_back(end);
        }
      }
    }
    std::sort(later.begin(), later.end());
    changed.insert(changed.end(), later.begin(), later.end());
    waiting.swap(later);
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  waiting.swap(changed);
}

// An influence too many joins its neighbour in the skeleton, so that what each other joint moves in all stays
// the same; without a neighbour, or without `join`, it goes. Of the `vertices`; becomes those that had any.
void cutInfluences(const Skeleton& skeleton, const std::vector<Hinge>& bends, int max_influences, bool join,
                   std::vector<int>& vertices, JointWeights& weights) {
  constexpr float kLeast = 1e-4f;  // nobody sees it move
  constexpr float kHinge = 4;      // what a hinge's weight is worth
  const int joints = static_cast<int>(weights.cols());
  std::vector<float> worth(joints, 1);
  for (const Hinge& hinge : bends) worth[hinge.joint] = kHinge;
  std::vector<int> cut, left;  // of `left`: the joints that a row still has, ascending
  for (const int v : vertices) {
    float* row = weights.row(v).data();
    left.clear();
    for (int j = 0; j < joints; ++j) {
      if (row[j] < kLeast) row[j] = 0;
      if (row[j] > 0) left.push_back(j);
    }
    int more = static_cast<int>(left.size()) - max_influences;
    if (more > 0) cut.push_back(v);
    for (; more > 0; --more) {
      int least = -1, from = -1, to = -1;
      float lowest = std::numeric_limits<float>::infinity();
      for (const int j : left) {
        if (least < 0 || row[j] <= row[least]) least = j;
        const int parent = skeleton.joints[j].parent;
        if (!join || parent < 0 || row[parent] == 0) continue;
        const float loss = worth[j] * std::min(row[j], row[parent]);
        if (loss >= lowest) continue;
        lowest = loss;
        from = row[j] <= row[parent] ? j : parent, to = row[j] <= row[parent] ? parent : j;
      }
      if (from < 0) {
        from = least;
      } else {
        row[to] += row[from];
      }
      row[from] = 0;
      left.erase(std::lower_bound(left.begin(), left.end(), from));
    }
    weights.row(v) /= weights.row(v).sum();
  }
  vertices.swap(cut);
}

}  // namespace

void partLimbs(const Skeleton& skeleton, const std::vector<int>& limbs, JointWeights& weights) {
  const int joints = static_cast<int>(weights.cols());
  std::vector<int> trunk(joints, -1);  // by limb
  for (int joint = joints - 1; joint > 0; --joint) {
    if (limbs[joint] >= 0) trunk[limbs[joint]] = skeleton.joints[joint].parent;
  }
  std::vector<float> sums(joints);
  for (Eigen::Index v = 0; v < weights.rows(); ++v) {
    std::fill(sums.begin(), sums.end(), 0.0f);
    for (int joint = 0; joint < joints; ++joint) {
      if (limbs[joint] >= 0) sums[limbs[joint]] += weights(v, joint);
    }
    const int first = static_cast<int>(std::max_element(sums.begin(), sums.end()) - sums.begin());
    float second = 0;
    for (int limb = 0; limb < joints; ++limb) {
      if (limb != first) second = std::max(second, sums[limb]);
    }
    if (second == 0) continue;
    for (int joint = 0; joint < joints; ++joint) {
      const int limb = limbs[joint];
      if (limb < 0) continue;
      weights(v, joint) *= limb == first ? 1 - second / sums[first] : 0;
    }
    for (int limb = 0; limb < joints; ++limb) {
      if (sums[limb] > 0) weights(v, trunk[limb]) += limb == first ? second : sums[limb];
    }
  }
}

void softenWeights(const TriangleMesh& mesh, const Skeleton& skeleton, int max_influences,
                   JointWeights& weights) {
  const std::vector<int> limbs = jointLimbs(skeleton);
  std::vector<Hinge> bends = hinges(skeleton, limbs);
  if (bends.size() * static_cast<std::size_t>(weights.rows()) > kMostHingeVertices) bends.clear();
  std::vector<int> all(weights.rows()), vertices;
  std::iota(all.begin(), all.end(), 0);
  for (const int v : all) weights.row(v) /= weights.row(v).sum();
  if (mesh.triangles.rows() == 0) {
    cutInfluences(skeleton, bends, max_influences, true, all, weights);
    return;
  }
  const Edges edges = edgesOf(static_cast<int>(mesh.vertices.rows()), mesh.triangles);
  for (Hinge& hinge : bends) hinge.allowed.assign(edges.to.size(), -1);
  const float size = (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).maxCoeff();
  const bool fine = meanEdge(mesh) < kFineMesh * size;
  std::vector<char> stiff(bends.size(), 1);
  for (int round = 0; round < kRounds; ++round) {
    // Smoothing mixes limbs where they touch, a little the second time.
    if (round < 2) partLimbs(skeleton, limbs, weights);
    for (std::size_t i = 0; i < bends.size(); ++i) {
      if (stiff[i]) bendSoftly(mesh, edges, bends[i], weights);
    }
    vertices = all;
    for (int attempt = 0; attempt < kTries && !vertices.empty(); ++attempt) {
      std::vector<int> changed = vertices;
      if (fine) smoothEdges(edges, changed, weights);
      // The joined weights of several vertices may again be too far apart for ever.
      cutInfluences(skeleton, bends, max_influences, attempt < 3, attempt == 0 ? vertices : changed, weights);
      if (attempt > 0) vertices.swap(changed);
      if (!fine) break;
    }
    bool any = false;
    for (std::size_t i = 0; i < bends.size(); ++i) {
      stiff[i] = tighten(mesh, skeleton, edges, weights, bends[i]);
      any = any || stiff[i];
    }
    if (!any && round > 0) break;
  }
}

}  // namespace skel
