// Shu & Yang (2018), Algorithm 1.
#include "libskel/candidates/candidates.h"

#include <algorithm>

#include "libskel/candidates/maximal_discs.h"

namespace skel {
namespace {

bool isMaximum(const DistanceField& distance, int x, int y, bool strict) {
  const float here = distance(y, x);
  if (here <= 0) return false;
  for (int ny = std::max(0, y - 1); ny <= std::min<int>(static_cast<int>(distance.rows()) - 1, y + 1); ++ny)
    for (int nx = std::max(0, x - 1); nx <= std::min<int>(static_cast<int>(distance.cols()) - 1, x + 1); ++nx)
      if ((nx != x || ny != y) && (distance(ny, nx) > here || (strict && distance(ny, nx) == here)))
        return false;
  return true;
}

std::vector<Eigen::Array2i> maxima(const DistanceField& distance, bool strict) {
  std::vector<Eigen::Array2i> found;
  for (int y = 0; y < distance.rows(); ++y)
    for (int x = 0; x < distance.cols(); ++x)
      if (isMaximum(distance, x, y, strict)) found.emplace_back(x, y);
  return found;
}

float squaredDistance(const JointCandidate& a, const JointCandidate& b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

// Squared radii are whole numbers, which squaring their rounded roots does not quite give back.
float squaredRadius(const JointCandidate& candidate) {
  return candidate.radius * candidate.radius * 1.00001f;
}

}  // namespace

CandidateSet extractCandidates(const Silhouette& silhouette, const CandidateOptions& options) {
  CandidateSet candidates;
  candidates.distance = distanceField(silhouette.grid_mask);
  const auto centres = options.method == CandidateMethod::kDiscs
                           ? maximalDiscs(candidates.distance)
                           : maxima(candidates.distance, options.method == CandidateMethod::kStrict);
  for (const Eigen::Array2i& p : centres)
    candidates.maxima.push_back(
        {static_cast<float>(p.x()), static_cast<float>(p.y()), candidates.distance(p.y(), p.x())});
  std::stable_sort(candidates.maxima.begin(), candidates.maxima.end(),
                   [](const JointCandidate& a, const JointCandidate& b) { return a.radius > b.radius; });
  candidates.kept = pruneByDiscs(candidates.maxima);
  return candidates;
}

std::vector<int> pruneByDiscs(const std::vector<JointCandidate>& maxima) {
  std::vector<int> kept;
  for (size_t i = 0; i < maxima.size(); ++i) {
    const bool covered = std::any_of(kept.begin(), kept.end(), [&](int k) {
      const JointCandidate& larger = maxima[static_cast<size_t>(k)];
      return squaredDistance(maxima[i], larger) <= squaredRadius(larger);
    });
    if (!covered) kept.push_back(static_cast<int>(i));
  }
  return kept;
}

double uncoveredShare(const CandidateSet& candidates, double factor) {
  int figure = 0, uncovered = 0;
  for (int y = 0; y < candidates.distance.rows(); ++y)
    for (int x = 0; x < candidates.distance.cols(); ++x) {
      if (candidates.distance(y, x) <= 0) continue;
      ++figure;
      const JointCandidate here{static_cast<float>(x), static_cast<float>(y), 0};
      uncovered += std::none_of(candidates.kept.begin(), candidates.kept.end(), [&](int k) {
        const JointCandidate& kept = candidates.maxima[static_cast<size_t>(k)];
        return squaredDistance(here, kept) <= factor * factor * squaredRadius(kept);
      });
    }
  return figure ? static_cast<double>(uncovered) / figure : 0;
}

}  // namespace skel
