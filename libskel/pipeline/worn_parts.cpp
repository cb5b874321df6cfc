#include "libskel/pipeline/worn_parts.h"
#include "libskel/core/smooth_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "libskel/pipeline/hanging_chains.h"
#include "libskel/skin/bones.h"
#include "libskel/skin/edges.h"
#include "libskel/skin/falloff.h"
#include "libskel/skin/smooth.h"

namespace skel {
namespace {

using Eigen::Index;
using Eigen::RowVectorXf;

constexpr float kLeast = .01f;     // of all vertices
constexpr float kHeld = .3f;       // of the thighs, and of what lies between them: less is no skirt
constexpr float kSwing = .4f;      // of a leg: so far down a skirt's hem would go with the thigh altogether
constexpr float kMostSwing = .8f;  // of the thigh's turn, of the shortest skirt
constexpr float kTail = .25f;      // of a piece: moved so far by the joints of a tail, it is the tail
constexpr float kAlone = .9f;      // of what a thing touches
constexpr float kApart = .15f;     // of a leg: hips so far apart in the picture push a side each

bool isWorn(Part part) {
  return part == Part::kHair || part == Part::kSkirt || part == Part::kAppendix || part == Part::kThing;
}

// Of each vertex, by its place in the drawing; where that shows another body of the mesh, by its neighbours.
std::vector<Part> partsOfVertices(const TriangleMesh& mesh, const LayerMap& layers, const Edges& edges) {
  const auto count = static_cast<std::size_t>(mesh.vertices.rows());
  std::vector<Part> parts(count, Part::kTrunk);
  std::vector<char> known(count, 0);
  std::deque<std::size_t> waiting;
  for (std::size_t v = 0; v < count; ++v) {
    const auto row = static_cast<Index>(v);
    const Eigen::Vector2d at =
        mesh.model_from_image.inverse(mesh.vertices.row(row).head<2>().transpose().cast<double>());
    const auto x = static_cast<Index>(std::lround(at.x())), y = static_cast<Index>(std::lround(at.y()));
    if (x < 0 || y < 0 || x >= layers.part.cols() || y >= layers.part.rows()) continue;
    const int own = mesh.layer.size() > 0 ? mesh.layer[row] : 0, seen = layers.any() ? layers.limb(y, x) : 0;
    if (own != seen) continue;
    parts[v] = static_cast<Part>(layers.part(y, x));
    known[v] = 1;
    waiting.push_back(v);
  }
  while (!waiting.empty()) {
    const std::size_t v = waiting.front();
    waiting.pop_front();
    for (int i = edges.first[v]; i < edges.first[v + 1]; ++i)
      if (const auto to = static_cast<std::size_t>(edges.to[static_cast<std::size_t>(i)]); !known[to])
        parts[to] = parts[v], known[to] = 1, waiting.push_back(to);
  }
  return parts;
}

// Connected vertices of one part; the crumbs are none.
std::vector<std::vector<int>> pieces(const std::vector<Part>& parts, const Edges& edges) {
  std::vector<std::vector<int>> found;
  std::vector<char> seen(parts.size(), 0);
  for (std::size_t start = 0; start < parts.size(); ++start) {
    if (seen[start] || !isWorn(parts[start])) continue;
    std::vector<int>& piece = found.emplace_back(1, static_cast<int>(start));
    seen[start] = 1;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const auto v = static_cast<std::size_t>(piece[i]);
      for (int k = edges.first[v]; k < edges.first[v + 1]; ++k) {
        const auto to = static_cast<std::size_t>(edges.to[static_cast<std::size_t>(k)]);
        if (!seen[to] && parts[to] == parts[start]) seen[to] = 1, piece.push_back(static_cast<int>(to));
      }
    }
  }
  const float least = kLeast * static_cast<float>(parts.size());
  std::erase_if(found,
                [&](const std::vector<int>& piece) { return static_cast<float>(piece.size()) < least; });
  return found;
}

struct Legs {
  std::array<int, 2> hips{}, knees{};  // joints
  int pelvis = 0;
  float top_m = 0, length_m = 0;
  std::array<float, 2> x_m{};  // of the hips
};

std::optional<Legs> legsOf(const Skeleton& skeleton, const SkeletonTemplate& body_plan) {
  Legs legs;
  std::size_t found = 0;
  float low = 0;
  for (const TemplateLimb& limb : body_plan.limbs) {
    if (limb.limb_class != JointClass::kLeg || found == 2) continue;
    const auto joint = [&](int i) {
      return skeleton.find(
          body_plan.joints[static_cast<std::size_t>(limb.joints[static_cast<std::size_t>(i)])].name);
    };
    const int hip = joint(0), knee = joint(1), foot = joint(2);
    if (hip < 0 || knee < 0 || foot < 0) return std::nullopt;
    const Eigen::Vector3f at = skeleton.joints[static_cast<std::size_t>(hip)].position.cast<float>();
    legs.hips[found] = hip, legs.knees[found] = knee;
    legs.x_m[found] = at.x();
    legs.top_m += at.y() / 2;
    low += static_cast<float>(skeleton.joints[static_cast<std::size_t>(foot)].position.y()) / 2;
    ++found;
  }
  if (found != 2) return std::nullopt;
  legs.pelvis = skeleton.joints[static_cast<std::size_t>(legs.hips[0])].parent;
  legs.length_m = legs.top_m - low;
  if (legs.pelvis < 0 || legs.length_m <= 0) return std::nullopt;
  return legs;
}

// What is drawn of one hangs over both thighs and closes what is between them; trousers do not.
bool wearsSkirt(const LayerMap& layers, const Skeleton& skeleton, const Legs& legs) {
  constexpr int kSamples = 16;
  const auto at = [&](int joint) { return skeleton.joints[static_cast<std::size_t>(joint)].image; };
  const auto held = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    int inside = 0;
    for (int i = 0; i < kSamples; ++i) {
      const Eigen::Vector2d p = from + (i + .5) / kSamples * (to - from);
      const auto x = static_cast<Index>(std::lround(p.x())), y = static_cast<Index>(std::lround(p.y()));
      inside += x >= 0 && y >= 0 && x < layers.part.cols() && y < layers.part.rows() &&
                static_cast<Part>(layers.part(y, x)) == Part::kSkirt;
    }
    return static_cast<float>(inside) >= kHeld * kSamples;
  };
  const Eigen::Vector2d a = at(legs.hips[0]), b = at(legs.hips[1]), c = at(legs.knees[0]),
                        d = at(legs.knees[1]);
  return held(a, c) && held(b, d) && held((a + b) / 2, (c + d) / 2);
}

// Above the hips it goes with the trunk as it did, limbs apart. What hangs from there, if anything.
std::optional<Hanging> hang(const TriangleMesh& mesh, const Legs& legs, const std::vector<int>& skirt,
                            JointWeights& weights) {
  float hem = legs.top_m, left = mesh.vertices(skirt[0], 0), right = left;
  for (const int v : skirt) {
    hem = std::min(hem, mesh.vertices(v, 1));
    left = std::min(left, mesh.vertices(v, 0)), right = std::max(right, mesh.vertices(v, 0));
  }
  const float drop = legs.top_m - hem, width = right - left;
  if (drop <= 0 || width <= 0) return std::nullopt;
  const float swing = std::min(kMostSwing, kSwing * legs.length_m / drop);
  const float apart = legs.x_m[1] - legs.x_m[0];
  const float turned = std::clamp(apart / (kApart * legs.length_m), -1.f, 1.f);
  Hanging hanging;
  float depth = 0;
  for (const int v : skirt) {
    const float down = legs.top_m - mesh.vertices(v, 1);
    if (down <= 0) continue;
    hanging.vertices.push_back(v);
    hanging.along.push_back(down / drop);
    depth += mesh.vertices(v, 2);
    const float across = (mesh.vertices(v, 0) - (left + right) / 2) / width;  // -.5….5
    const float second = .5f + turned * across, push = swing * smoothStep(down / drop);
    weights.row(v).setZero();
    weights(v, legs.pelvis) = 1 - push;
    weights(v, legs.hips[0]) = push * (1 - second);
    weights(v, legs.hips[1]) = push * second;
  }
  hanging.carrier = legs.pelvis;
  depth /= static_cast<float>(hanging.vertices.size());
  hanging.from = {(legs.x_m[0] + legs.x_m[1]) / 2, legs.top_m, depth};
  hanging.to = {(left + right) / 2, hem, depth};
  hanging.share = std::min(1.f, drop / width);  // a wide hem that turned as far would dip into the ground
  return hanging;
}

// Of what joints move, the share of each joint of one limb, or of the trunk (-1), in what they move together.
RowVectorXf shareOf(int limb, const std::vector<int>& limbs, RowVectorXf moved) {
  for (Index j = 0; j < moved.size(); ++j)
    if (limbs[static_cast<std::size_t>(j)] != limb) moved[j] = 0;
  return moved / moved.sum();
}

// As one with the joint that moves most of what the piece touches; with `trunk_alone`, what limbs move apart.
// Returns how much each joint moves of that.
RowVectorXf ride(const Edges& edges, const std::vector<int>& limbs, const std::vector<int>& piece,
                 bool trunk_alone, JointWeights& weights) {
  std::vector<char> own(static_cast<std::size_t>(weights.rows()), 0);
  for (const int v : piece) own[static_cast<std::size_t>(v)] = 1;
  std::vector<int> touched;
  for (const int v : piece)
    for (int k = edges.first[static_cast<std::size_t>(v)]; k < edges.first[static_cast<std::size_t>(v) + 1];
         ++k)
      if (const int to = edges.to[static_cast<std::size_t>(k)]; !own[static_cast<std::size_t>(to)])
        touched.push_back(to);
  RowVectorXf sum = RowVectorXf::Zero(weights.cols());
  for (const int v : touched) sum += weights.row(v);
  if (trunk_alone)
    for (Index j = 0; j < sum.size(); ++j)
      if (limbs[static_cast<std::size_t>(j)] >= 0) sum[j] = 0;
  Index most = 0;
  if (touched.empty() || sum.maxCoeff(&most) <= 0) return sum;
  const RowVectorXf carried = shareOf(limbs[static_cast<std::size_t>(most)], limbs, sum);
  for (const int v : piece) weights.row(v) = carried;
  return sum;
}

// A piece of a thing, and how much each joint moves of what it touches.
struct TouchedThing {
  const std::vector<int>& vertices;
  RowVectorXf moved;
};

// What a limb alone holds, beyond its upper half, moves as one: what is on both sides of a hand stays in one
// piece. What touches other things, too, goes as far as all of them do.
void rideTogether(const Skeleton& skeleton, const std::vector<int>& limbs,
                  const std::vector<TouchedThing>& things, JointWeights& weights) {
  std::map<int, RowVectorXf> by_limb;
  // The limb that holds the thing, -1: none alone, or its upper half.
  const auto limbOf = [&](const TouchedThing& thing) {
    Index most = 0;
    if (thing.moved.maxCoeff(&most) <= 0) return -1;
    const int limb = limbs[static_cast<std::size_t>(most)];
    const int parent = skeleton.joints[static_cast<std::size_t>(most)].parent;
    if (parent < 0 || limbs[static_cast<std::size_t>(parent)] != limb) return -1;
    float of_limb = 0;
    for (std::size_t j = 0; j < limbs.size(); ++j)
      if (limbs[j] == limb) of_limb += thing.moved[static_cast<Index>(j)];
    return of_limb >= kAlone * thing.moved.sum() ? limb : -1;
  };
  for (const TouchedThing& thing : things)
    if (const int limb = limbOf(thing); limb >= 0)
      by_limb.try_emplace(limb, RowVectorXf::Zero(weights.cols())).first->second += thing.moved;
  for (const TouchedThing& thing : things) {
    const int limb = limbOf(thing);
    if (limb < 0) continue;
    const RowVectorXf carried = shareOf(limb, limbs, by_limb.at(limb));
    for (const int v : thing.vertices) weights.row(v) = carried;
  }
}

// Which joints are those of a tail, if the body plan has any: of a limb that is no arm, leg or head.
std::vector<char> tailJoints(const Skeleton& skeleton, const SkeletonTemplate& body_plan,
                             const std::vector<int>& limbs) {
  std::vector<int> others;
  const auto add = [&](int joint_of_plan) {
    if (joint_of_plan < 0) return;
    const int joint = skeleton.find(body_plan.joints[static_cast<std::size_t>(joint_of_plan)].name);
    if (joint >= 0) others.push_back(limbs[static_cast<std::size_t>(joint)]);
  };
  add(body_plan.head);
  for (const TemplateLimb& limb : body_plan.limbs) add(limb.joints[2]);
  std::vector<char> tail;
  for (const int limb : limbs)
    tail.push_back(limb >= 0 && std::find(others.begin(), others.end(), limb) == others.end());
  return tail;
}

bool isMovedBy(const std::vector<char>& joints, const std::vector<int>& piece, const JointWeights& weights) {
  float sum = 0;
  for (const int v : piece)
    for (std::size_t j = 0; j < joints.size(); ++j)
      if (joints[j]) sum += weights(v, static_cast<Index>(j));
  return sum > kTail * static_cast<float>(piece.size());
}

}  // namespace

void carryWornParts(const TriangleMesh& mesh, const SkeletonTemplate& body_plan, const LayerMap& layers,
                    Skeleton& skeleton, SkinWeights& weights) {
  const int count = static_cast<int>(mesh.vertices.rows());
  if (layers.part.size() == 0 || count == 0) return;
  const Edges edges = edgesOf(count, mesh.triangles);
  const std::vector<Part> parts = partsOfVertices(mesh, layers, edges);
  const std::vector<std::vector<int>> found = pieces(parts, edges);
  if (found.empty()) return;
  const JointWeights flesh = unpackWeights(weights, static_cast<int>(skeleton.joints.size()));
  JointWeights rows = flesh;
  const std::vector<int> limbs = jointLimbs(skeleton);
  const std::vector<char> tail = tailJoints(skeleton, body_plan, limbs);
  const std::optional<Legs> legs = legsOf(skeleton, body_plan);
  const bool skirted = legs && wearsSkirt(layers, skeleton, *legs);
  std::vector<Hanging> hanging;
  std::vector<TouchedThing> things;
  std::map<std::string, int> named;
  const auto add = [&](const std::string& what, std::optional<Hanging> hangs) {
    if (!hangs) return;
    const int nth = ++named[what];
    hangs->what = nth == 1 ? what : what + std::to_string(nth);
    hanging.push_back(std::move(*hangs));
  };
  for (const std::vector<int>& piece : found) {
    const Part part = parts[static_cast<std::size_t>(piece[0])];
    if (part == Part::kAppendix && isMovedBy(tail, piece, flesh)) continue;
    if (part == Part::kAppendix) ride(edges, limbs, piece, true, rows);
    if (part == Part::kThing) things.push_back({piece, ride(edges, limbs, piece, false, rows)});
    if (part == Part::kSkirt && skirted) add("skirt", hang(mesh, *legs, piece, rows));
    if (part == Part::kAppendix) add("cape", hangingFrom(mesh, edges, skeleton, piece, rows));
    if (part == Part::kHair) add("hair", hangingFrom(mesh, edges, skeleton, piece, rows));
  }
  rideTogether(skeleton, limbs, things, rows);
  if (rows == flesh && hanging.empty()) return;
  for (const Hanging& it : hanging) hangOnChain(mesh, it, skeleton, rows);
  keepHeaviest(4, rows);
  weights = packWeights(rows);
}

}  // namespace skel
