#include "libskel/pipeline/hanging_chains.h"
#include "libskel/core/smooth_step.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "libskel/skeleton/hanging.h"
#include "libskel/skin/bones.h"

namespace skel {
namespace {

using Eigen::Index;
using Eigen::Vector3f;

constexpr float kShortest = .06f;  // of the figure's height
constexpr float kGround = .03f;    // of the figure's height: what reaches so far down stands on it
constexpr float kTip = .85f;       // of the way along: what lies beyond is the end

// From the nearest of the `begin` along edges that stay among the `inside`, m. Dijkstra, 1959.
std::vector<float> distancesAlong(const TriangleMesh& mesh, const Edges& edges,
                                  const std::vector<char>& inside, const std::vector<int>& begin) {
  std::vector<float> far(inside.size(), std::numeric_limits<float>::infinity());
  using Reached = std::pair<float, int>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  for (const int v : begin) open.emplace(far[static_cast<std::size_t>(v)] = 0.f, v);
  while (!open.empty()) {
    const auto [way, v] = open.top();
    open.pop();
    const auto from = static_cast<std::size_t>(v);
    if (way > far[from]) continue;
    for (int k = edges.first[from]; k < edges.first[from + 1]; ++k) {
      const int next = edges.to[static_cast<std::size_t>(k)];
      const auto to = static_cast<std::size_t>(next);
      const float longer = way + (mesh.vertices.row(next) - mesh.vertices.row(v)).norm();
      if (inside[to] && longer < far[to]) open.emplace(far[to] = longer, next);
    }
  }
  return far;
}

// Of what the carrier carries: it, the rest of its limb (the head, for hair), and the trunk.
bool goesWith(const std::vector<int>& limbs, int joint, int carrier) {
  const int limb = limbs[static_cast<std::size_t>(joint)];
  return limb < 0 || limb == limbs[static_cast<std::size_t>(carrier)];
}

// The joint of the trunk or the head that moves most of these vertices; -1: none does.
int carrierOfVertices(const Skeleton& skeleton, const std::vector<int>& limbs,
                      const std::vector<int>& vertices, const JointWeights& weights) {
  const int head = skeleton.find("head");
  Eigen::RowVectorXf sum = Eigen::RowVectorXf::Zero(weights.cols());
  for (const int v : vertices) sum += weights.row(v);
  int most = -1;
  for (int j = 0; j < static_cast<int>(skeleton.joints.size()); ++j) {
    const int limb = limbs[static_cast<std::size_t>(j)];
    if (limb >= 0 && (head < 0 || limb != limbs[static_cast<std::size_t>(head)])) continue;
    if (sum[j] > (most < 0 ? 0.f : sum[most])) most = j;
  }
  return most;
}

Vector3f middleOf(const TriangleMesh& mesh, const std::vector<int>& vertices) {
  Vector3f sum = Vector3f::Zero();
  for (const int v : vertices) sum += mesh.vertices.row(v).transpose();
  return sum / static_cast<float>(vertices.size());
}

}  // namespace

std::optional<Hanging> hangingFrom(const TriangleMesh& mesh, const Edges& edges, const Skeleton& skeleton,
                                   const std::vector<int>& vertices, const JointWeights& weights) {
  const float ground = mesh.vertices.col(1).minCoeff(), height = mesh.vertices.col(1).maxCoeff() - ground;
  std::vector<char> own(static_cast<std::size_t>(mesh.vertices.rows()), 0);
  float lowest = std::numeric_limits<float>::infinity();
  for (const int v : vertices) {
    own[static_cast<std::size_t>(v)] = 1;
    lowest = std::min(lowest, mesh.vertices(v, 1));
  }
  if (lowest < ground + kGround * height) return std::nullopt;
  const std::vector<int> limbs = jointLimbs(skeleton);
  const int carrier = carrierOfVertices(skeleton, limbs, vertices, weights);
  if (carrier < 0) return std::nullopt;
  const auto isCarried = [&](int v) {
    float share = 0;
    for (Index j = 0; j < weights.cols(); ++j)
      if (goesWith(limbs, static_cast<int>(j), carrier)) share += weights(v, j);
    return share > .5f;
  };
  std::vector<int> begin;
  for (const int v : vertices) {
    const auto row = static_cast<std::size_t>(v);
    const auto touches = [&](int to) { return !own[static_cast<std::size_t>(to)] && isCarried(to); };
    if (std::any_of(edges.to.begin() + edges.first[row], edges.to.begin() + edges.first[row + 1], touches))
      begin.push_back(v);
  }
  if (begin.empty()) return std::nullopt;

  const std::vector<float> far = distancesAlong(mesh, edges, own, begin);
  float farthest = 0;
  for (const int v : vertices) farthest = std::max(farthest, far[static_cast<std::size_t>(v)]);
  if (farthest < kShortest * height) return std::nullopt;
  Hanging hanging;
  hanging.carrier = carrier;
  hanging.vertices = vertices;
  std::vector<int> end;
  for (const int v : vertices) {
    hanging.along.push_back(far[static_cast<std::size_t>(v)] / farthest);
    if (hanging.along.back() > kTip) end.push_back(v);
  }
  hanging.from = middleOf(mesh, begin);
  hanging.to = middleOf(mesh, end);
  if ((hanging.to - hanging.from).norm() < kShortest * height) return std::nullopt;
  return hanging;
}

void hangOnChain(const TriangleMesh& mesh, const Hanging& hanging, Skeleton& skeleton,
                 JointWeights& weights) {
  const std::vector<int> limbs = jointLimbs(skeleton);
  const Index count = weights.cols();
  for (int link = 0; link < 2; ++link) {
    Joint joint;
    joint.name = hangingJointName(hanging.what, link + 1);
    joint.parent = link == 0 ? hanging.carrier : static_cast<int>(count);
    joint.position = (hanging.from + (link == 0 ? 0.f : .5f) * (hanging.to - hanging.from)).cast<double>();
    joint.image = mesh.model_from_image.inverse(joint.position.head<2>());
    joint.confidence = 1;
    joint.origin = JointOrigin::kDerived;
    skeleton.joints.push_back(joint);
  }
  weights.conservativeResize(Eigen::NoChange, count + 2);
  weights.rightCols<2>().setZero();
  for (std::size_t i = 0; i < hanging.vertices.size(); ++i) {
    const int v = hanging.vertices[i];
    const float first = hanging.share * smoothStep(2 * hanging.along[i]),
                second = smoothStep(2 * hanging.along[i] - 1);
    float moved = 0;
    for (Index j = 0; j < count; ++j) {
      if (!goesWith(limbs, static_cast<int>(j), hanging.carrier)) continue;
      moved += first * weights(v, j);
      weights(v, j) *= 1 - first;
    }
    weights(v, count) = moved * (1 - second);
    weights(v, count + 1) = moved * second;
  }
}

}  // namespace skel
