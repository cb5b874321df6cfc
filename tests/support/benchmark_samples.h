// The fixed data on which trainers are compared: 2,124 samples (as many as the paper had) of 3 inputs and 4
// classes, placed like the candidates of a figure with its arms out, 2 % of the labels wrong.
#pragma once

#include <algorithm>

#include "libskel/core/rng.h"
#include "trainer/samples.h"

namespace skel {

inline Samples benchmarkSamples() {
  constexpr int kCount = 2124;
  constexpr double kNoise = 0.02;
  Rng rng(2018);
  Samples samples{Eigen::MatrixXf(kCount, 3), Eigen::MatrixXf(kCount, 2), Eigen::VectorXf::Ones(kCount)};
  for (int i = 0; i < kCount; ++i) {
    std::uint32_t label = rng.below(kJointClassCount);
    const double side = rng.chance(0.5) ? 1 : -1;
    const auto put = [&](double x, double y, double radius, double spread_x, double spread_y,
                         double spread_radius) {
      const double numbers[] = {rng.normal(x, spread_x), rng.normal(y, spread_y),
                                rng.normal(radius, spread_radius)};
      for (int k = 0; k < 3; ++k) samples.inputs(i, k) = static_cast<float>(std::clamp(numbers[k], 0., 1.));
    };
    switch (static_cast<JointClass>(label)) {
      case JointClass::kHead:
        put(0.5, 0.14, 0.7, 0.08, 0.07, 0.15);
        break;
      case JointClass::kBody:
        put(0.5, 0.48, 0.75, 0.08, 0.1, 0.12);
        break;
      case JointClass::kHand:
        put(0.5 + 0.35 * side, 0.42, 0.2, 0.09, 0.12, 0.08);
        break;
      case JointClass::kLeg:
        put(0.5 + 0.1 * side, 0.84, 0.25, 0.06, 0.09, 0.08);
        break;
    }
    if (rng.chance(kNoise)) label = (label + 1 + rng.below(kJointClassCount - 1)) % kJointClassCount;
    samples.targets.row(i) << static_cast<float>(kJointClassCodes[label][0]),
        static_cast<float>(kJointClassCodes[label][1]);
  }
  return samples;
}

// Share of the samples of which both bits are right.
inline double accuracyOn(const Samples& samples, const Mlp& mlp) {
  const Eigen::MatrixXf outputs = evaluate(mlp, samples.inputs);
  Eigen::Index right = 0;
  for (Eigen::Index i = 0; i < outputs.rows(); ++i)
    right += ((outputs.row(i).array() > 0.5f) == (samples.targets.row(i).array() > 0.5f)).all();
  return static_cast<double>(right) / static_cast<double>(outputs.rows());
}

}  // namespace skel
