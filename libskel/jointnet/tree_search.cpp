// Exact dynamic programming over the best cells of each heatmap, as in pictorial structures: P. Felzenszwalb,
// D. Huttenlocher, "Pictorial structures for object recognition" (2005), §3. A bone that ends a limb depends
// on the one before it as well; it is carried along for each length that the other may get.
#include "libskel/jointnet/tree_search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace skel {
namespace {

using Vec = Eigen::Vector2d;

constexpr std::size_t kCandidates = 30;  // cells a joint that the search looks at
constexpr float kLeastShare = 1e-4f;     // of the highest probability: what such a cell needs
constexpr double kOutsidePenalty = 4;    // nats for a bone that lies wholly outside the figure
constexpr double kBoneSample = 2;        // grid px between samples along a bone
// Of a length's nats, which the heatmaps know in part, what counts; and how many there are at most.
constexpr double kLengthShare = .5, kMostNats = 6;

// Share of the bone between two points that lies outside the figure. A sample halfway between two columns
// counts for both, so that a mirrored figure gives the same.
double shareOutside(const Plane8& mask, const Vec& a, const Vec& b) {
  constexpr double kHalf = .5 + 1e-6;
  const int steps = std::max(1, static_cast<int>((b - a).norm() / kBoneSample));
  const auto outside = [&](int y, int x) {
    return y < 0 || x < 0 || y >= mask.rows() || x >= mask.cols() || mask(y, x) == 0;
  };
  int sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const Vec p = a + (b - a) * (static_cast<double>(i) / steps);
    const int y = static_cast<int>(std::floor(p.y() + .5));
    const int last = static_cast<int>(std::floor(p.x() + kHalf)),
              first = static_cast<int>(std::ceil(p.x() - kHalf));
    sum += outside(y, first) + outside(y, last);
  }
  return static_cast<double>(sum) / (2 * (steps + 1));
}

double surprise(double value, double mean, double deviation) {
  const double z = (value - mean) / deviation;
  return kLengthShare * std::min(z * z / 2, kMostNats);
}

// One way for a limb to end: the last bone's log length, and the score but for its proportion.
struct End {
  double score, log_length;
  std::size_t candidate;
};

struct Candidate {
  int cell, id;
  Vec position;  // grid px
  double score;  // log probability, later with at least the best of the joints below it
  // Of each child joint, the candidate that is best with this one.
  std::array<std::uint8_t, kMaxNetJoints> below;
};

class TreeSearch {
 public:
  TreeSearch(const Plane8& mask, const Vec& offset, const std::vector<Heatmap>& heatmaps,
             const NetJoints& joints, const std::vector<BoneLength>& bones)
      : mask_(mask), joints_(joints), bones_(bones), children_(heatmaps.size()), ends_(heatmaps.size()) {
    for (int j = 0; j < joints.count(); ++j)
      if (joints.parent[j] >= 0) children_[joints.parent[j]].push_back(j);
    for (const Heatmap& map : heatmaps) candidates_.push_back(likely(map, offset));
  }

  std::vector<int> run() {
    for (int i = joints_.count() - 1; i > 0; --i) hangUp(joints_.order[i]);
    std::vector<const Candidate*> chosen(candidates_.size());
    std::vector<int> cells(candidates_.size());
    for (const int j : joints_.order) {
      const int parent = joints_.parent[j];
      if (parent < 0)
        chosen[j] =
            &*std::max_element(candidates_[j].begin(), candidates_[j].end(),
                               [](const Candidate& a, const Candidate& b) { return a.score < b.score; });
      else if (endsLimb(j))
        chosen[j] = &candidates_[j][bestEnd(j, *chosen[parent],
                                            logLength(*chosen[joints_.parent[parent]], *chosen[parent]))
                                        .candidate];
      else
        chosen[j] = &candidates_[j][chosen[parent]->below[j]];
      cells[j] = chosen[j]->cell;
    }
    return cells;
  }

 private:
  static std::vector<Candidate> likely(const Heatmap& map, const Vec& offset) {
    const float least = *std::max_element(map.begin(), map.end()) * kLeastShare;
    std::vector<Candidate> list;
    for (int i = 0; i < kHeatmapCells; ++i)
      if (map[i] >= least) list.push_back({i, 0, Vec::Zero(), std::log(static_cast<double>(map[i])), {}});
    const std::size_t kept = std::min(list.size(), kCandidates);
    std::partial_sort(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(kept), list.end(),
                      [](const Candidate& a, const Candidate& b) {
                        return a.score != b.score ? a.score > b.score : a.cell < b.cell;
                      });
    list.resize(kept);
    for (std::size_t k = 0; k < kept; ++k) {
      list[k].id = static_cast<int>(k);
      list[k].position =
          frameFromCell(Vec(list[k].cell % kHeatmapSize, list[k].cell / kHeatmapSize)) - offset;
    }
    return list;
  }

  bool endsLimb(int j) const {
    return !bones_.empty() && bones_[j].ratio_deviation > 0 && children_[j].empty() &&
           joints_.parent[joints_.parent[j]] >= 0;
  }
  static double logLength(const Candidate& a, const Candidate& b) {
    return BoneLength::logOf((a.position - b.position).norm());
  }
  double lengthCost(int j, double log_length) const {
    return bones_.empty() || bones_[j].deviation == 0
               ? 0
               : surprise(log_length, bones_[j].mean, bones_[j].deviation);
  }

  // Of joint j, given the one before it and the log length of the bone that leads there: with its proportion.
  End bestEnd(int j, const Candidate& before, double log_length_before) const {
    End best{-std::numeric_limits<double>::infinity(), 0, 0};
    for (const End& end : ends_[j][before.id]) {
      if (end.score <= best.score) break;  // they come by falling score
      const double score = end.score - surprise(end.log_length - log_length_before, bones_[j].ratio_mean,
                                                bones_[j].ratio_deviation);
      if (score > best.score) best = {score, end.log_length, end.candidate};
    }
    return best;
  }

  // Adds the best of joint j to the candidates of its parent.
  void hangUp(int j) {
    std::vector<Candidate>& list = candidates_[j];
    std::stable_sort(list.begin(), list.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    std::vector<Candidate>& parents = candidates_[joints_.parent[j]];
    if (endsLimb(j)) {
      ends_[j].resize(parents.size());
      for (Candidate& parent : parents) parent.score += addEnds(j, parent);
      return;
    }
    std::vector<int> limb_ends;
    for (const int child : children_[j])
      if (endsLimb(child)) limb_ends.push_back(child);
    for (Candidate& parent : parents) {
      double best = -std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < list.size(); ++k) {
        // They come by falling score: no later one can win, even without any penalty.
        if (list[k].score <= best) break;
        const double log_length = logLength(parent, list[k]);
        double s = list[k].score - lengthCost(j, log_length);
        for (const int end : limb_ends)
          s += bestEnd(end, list[k], log_length).score - ends_[end][list[k].id].front().score;
        if (s <= best) continue;
        s -= kOutsidePenalty * shareOutside(mask_, parent.position, list[k].position);
        if (s > best) best = s, parent.below[j] = static_cast<std::uint8_t>(k);
      }
      parent.score += best;
    }
  }

  // The ways to end at joint j from a candidate of its parent; returns the highest of their scores.
  double addEnds(int j, const Candidate& parent) {
    std::vector<End>& ends = ends_[j][parent.id];
    for (std::size_t k = 0; k < candidates_[j].size(); ++k) {
      const Candidate& end = candidates_[j][k];
      const double log_length = logLength(parent, end);
      ends.push_back({end.score - lengthCost(j, log_length) -
                          kOutsidePenalty * shareOutside(mask_, parent.position, end.position),
                      log_length, k});
    }
    std::stable_sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.score > b.score; });
    return ends.front().score;
  }

  const Plane8& mask_;
  const NetJoints& joints_;
  const std::vector<BoneLength>& bones_;
  std::vector<std::vector<int>> children_;
  std::vector<std::vector<Candidate>> candidates_;   // by joint
  std::vector<std::vector<std::vector<End>>> ends_;  // of joints that end limbs: by candidate of the parent
};

}  // namespace

std::vector<int> searchTree(const Plane8& mask, const Vec& offset, const std::vector<Heatmap>& heatmaps,
                            const NetJoints& joints, const std::vector<BoneLength>& bones) {
  return TreeSearch(mask, offset, heatmaps, joints, bones).run();
}

}  // namespace skel
