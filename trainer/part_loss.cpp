#include "trainer/part_loss.h"

#include <algorithm>
#include <cmath>

#include "libskel/layers/part_net.h"

namespace skel {
namespace {

// What is seldom seen must not become a limb.
constexpr std::array<double, kPartCount> kWeights = {1, 1, 1.7, 1.4, 1.4, 1.4, 1.4, 2, 1.7, 1.7};
constexpr double kBeforeWeight = .2;

int limbOf(int part) {
  const int limb = part - static_cast<int>(Part::kRightArm);
  return limb >= 0 && limb < 4 ? limb : -1;
}

}  // namespace

double partLoss(const std::vector<float>& logits, const cv::Mat& part, const std::array<int, 4>& before,
                double scale, std::vector<float>* gradient) {
  double weights = 0, ordered = 0;
  const auto beforeAt = [&](int is) {
    return limbOf(is) < 0 ? -1 : before[static_cast<std::size_t>(limbOf(is))];
  };
  const auto weightOf = [](int is) { return kWeights[static_cast<std::size_t>(is)]; };
  for (int y = 0; y < part.rows; ++y)
    for (int x = 0; x < part.cols; ++x) {
      const int is = part.at<std::uint8_t>(y, x);
      if (is >= kPartCount) continue;
      weights += weightOf(is);
      ordered += beforeAt(is) >= 0;
    }
  if (weights == 0) return 0;
  double entropy = 0, order_entropy = 0;
  for (int y = 0; y < part.rows; ++y)
    for (int x = 0; x < part.cols; ++x) {
      const int is = part.at<std::uint8_t>(y, x);
      if (is >= kPartCount) continue;
      const float* z = logits.data() + partLogitIndex(y, x, 0);
      const double w = weightOf(is) / weights, most = *std::max_element(z, z + kPartCount);
      std::array<double, kPartCount> p;
      double sum = 0;
      for (int k = 0; k < kPartCount; ++k) sum += p[std::size_t(k)] = std::exp(z[k] - most);
      entropy += w * (std::log(sum) + most - z[is]);
      if (gradient != nullptr)
        for (int k = 0; k < kPartCount; ++k)
          (*gradient)[partLogitIndex(y, x, k)] +=
              static_cast<float>(scale * w * (p[std::size_t(k)] / sum - (k == is)));
      const int first = beforeAt(is);
      if (first < 0) continue;
      const double o = z[kPartCount];
      order_entropy += (std::max(o, 0.) + std::log1p(std::exp(-std::abs(o))) - first * o) / ordered;
      if (gradient != nullptr)
        (*gradient)[partLogitIndex(y, x, kPartCount)] +=
            static_cast<float>(scale * kBeforeWeight * (1 / (1 + std::exp(-o)) - first) / ordered);
    }
  return entropy + kBeforeWeight * order_entropy;
}

}  // namespace skel
