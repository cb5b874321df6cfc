#include "libskel/recognition/confidence_model.h"

#include <algorithm>
#include <cmath>

#include "libskel/core/check.h"

namespace skel {
Eigen::VectorXd figureInputs(const Evidence& evidence, const LogisticNet& joint) {
  constexpr double kMost = 6;
  std::vector<double> sure;
  double all = 0;
  for (Eigen::Index j = 0; j < evidence.joints.rows(); ++j) {
    if (!evidence.counts[static_cast<std::size_t>(j)]) continue;
    const double log_odds = joint.logOdds(evidence.joints.row(j).matrix().transpose());
    sure.push_back(std::clamp(log_odds, -kMost, kMost));
    all -= std::log1p(std::exp(-sure.back()));
  }
  SKEL_CHECK(!sure.empty());
  std::sort(sure.begin(), sure.end());
  double mean = 0;
  for (const double s : sure) mean += s / static_cast<double>(sure.size());
  const auto least = [&](std::size_t k) { return sure[std::min(k, sure.size() - 1)]; };
  Eigen::VectorXd inputs(static_cast<Eigen::Index>(kFigureInputs.size() + kJointSummary.size()));
  inputs << evidence.figure.matrix(), least(0), least(1), least(2), mean, all;
  return inputs;
}

Confidences confidencesOf(const Evidence& evidence, const ConfidenceModel& model) {
  Confidences confidences;
  for (Eigen::Index j = 0; j < evidence.joints.rows(); ++j)
    confidences.joints.push_back(model.joint.probability(evidence.joints.row(j).matrix().transpose()));
  confidences.figure = model.figure.probability(figureInputs(evidence, model.joint));
  return confidences;
}

}  // namespace skel
