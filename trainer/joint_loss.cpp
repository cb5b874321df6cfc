#include "trainer/joint_loss.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace skel {
JointTarget jointTarget(const Figure& figure, const FramePlacement& placement, const NetJoints& joints) {
  constexpr double kHiddenWeight = .6;  // of a covered joint
  constexpr double kAbsentWeight = .3;
  JointTarget target;
  target.whole = figure.whole;
  for (int j = 0; j < joints.count(); ++j) {
    const int from = placement.mirrored ? joints.mirrored[j] : j;
    target.joints.push_back({cellFromFrame(placement.frameFromGrid(figure.joints[from])),
                             !figure.whole || figure.unknown[from] ? 0
                             : figure.absent[from]                 ? kAbsentWeight
                             : figure.visible[from]                ? 1
                                                                   : kHiddenWeight,
                             static_cast<bool>(figure.absent[from])});
  }
  return target;
}

template <typename Scalar>
double jointLoss(const std::vector<Scalar>& heatmaps, const JointTarget& target, double scale,
                 std::vector<Scalar>* gradient) {
  constexpr int kSize = kHeatmapSize;
  const int count = static_cast<int>(target.joints.size()), figure_channel = count;
  const auto at = [channels = heatmapChannels(count)](int cell, int channel) {
    return static_cast<std::size_t>(paddedIndex(kSize, cell / kSize, cell % kSize)) * channels + channel;
  };
  double loss = 0;
  std::array<Scalar, kSize * kSize> p;
  for (int j = 0; j < count; ++j) {
    const JointTarget::Joint& joint = target.joints[j];
    if (joint.weight == 0) continue;
    Scalar highest = heatmaps[at(0, j)];
    for (int i = 0; i < kSize * kSize; ++i) highest = std::max(highest, heatmaps[at(i, j)]);
    Scalar sum = 0;
    for (int i = 0; i < kSize * kSize; ++i) sum += p[i] = std::exp(heatmaps[at(i, j)] - highest);

    std::array<double, kSize> gx, gy;
    double sum_x = 0, sum_y = 0;
    for (int k = 0; k < kSize; ++k) {
      const double dx = k - joint.cell.x(), dy = k - joint.cell.y();
      sum_x += gx[k] = std::exp(-dx * dx / (2 * kTargetVariance));
      sum_y += gy[k] = std::exp(-dy * dy / (2 * kTargetVariance));
    }
    // A joint outside the frame has no cell to point at.
    if (!joint.absent && sum_x * sum_y < .5) continue;
    const double weight = joint.weight / count;
    for (int i = 0; i < kSize * kSize; ++i) {
      const double wanted =
          joint.absent ? 1. / (kSize * kSize) : gx[i % kSize] * gy[i / kSize] / (sum_x * sum_y);
      if (wanted > 1e-9) loss -= weight * wanted * (heatmaps[at(i, j)] - highest - std::log(sum));
      if (gradient) (*gradient)[at(i, j)] += static_cast<Scalar>(scale * weight * (p[i] / sum - wanted));
    }
  }
  double logit = 0;
  for (int i = 0; i < kSize * kSize; ++i) logit += heatmaps[at(i, figure_channel)];
  logit /= kSize * kSize;
  const double probability = 1 / (1 + std::exp(-logit)), wanted = target.whole ? 1 : 0;
  // log(1 + e^x) without overflow.
  loss += kFigureWeight * (std::max(logit, 0.) + std::log1p(std::exp(-std::abs(logit))) - wanted * logit);
  if (gradient) {
    const double g = scale * kFigureWeight * (probability - wanted) / (kSize * kSize);
    for (int i = 0; i < kSize * kSize; ++i) (*gradient)[at(i, figure_channel)] += static_cast<Scalar>(g);
  }
  return loss;
}

template double jointLoss(const std::vector<float>&, const JointTarget&, double, std::vector<float>*);
template double jointLoss(const std::vector<double>&, const JointTarget&, double, std::vector<double>*);

}  // namespace skel
