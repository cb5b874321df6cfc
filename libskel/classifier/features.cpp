#include "libskel/classifier/features.h"

namespace skel {

Features features(const CandidateSet& candidates) {
  Features result(static_cast<Eigen::Index>(candidates.maxima.size()), 3);
  for (Eigen::Index i = 0; i < result.rows(); ++i) {
    const JointCandidate& candidate = candidates.maxima[static_cast<std::size_t>(i)];
    result.row(i) << candidate.x, candidate.y, candidate.radius;
  }
  if (result.rows() == 0) return result;
  for (auto column : result.colwise()) {
    const float low = column.minCoeff(), range = column.maxCoeff() - low;
    if (range > 0)
      column = ((column.array() - low) / range).matrix();
    else
      column.setConstant(0.5f);
  }
  return result;
}

}  // namespace skel
