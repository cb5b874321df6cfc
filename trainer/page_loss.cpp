#include "trainer/page_loss.h"

#include <algorithm>
#include <cmath>

#include "libskel/silhouette/page_net.h"

namespace skel {

double pageLoss(const std::vector<float>& logits, const cv::Mat& figure, double scale,
                std::vector<float>* gradient) {
  const double pixels = static_cast<double>(figure.total());
  double entropy = 0, both = 0, sum = 1;  // 1: so that nothing seen where nothing is costs nothing
  const auto probabilityOf = [&](int y, int x) {
    return 1 / (1 + std::exp(-static_cast<double>(logits[pageLogitIndex(y, x)])));
  };
  for (int y = 0; y < figure.rows; ++y)
    for (int x = 0; x < figure.cols; ++x) {
      const double z = logits[pageLogitIndex(y, x)], wanted = figure.at<std::uint8_t>(y, x) / 255.,
                   p = probabilityOf(y, x);
      // log(1 + e^z) without overflow.
      entropy += std::max(z, 0.) + std::log1p(std::exp(-std::abs(z))) - wanted * z;
      both += p * wanted;
      sum += p + wanted;
    }
  const double dice = 1 - (2 * both + 1) / sum;
  if (gradient != nullptr)
    for (int y = 0; y < figure.rows; ++y)
      for (int x = 0; x < figure.cols; ++x) {
        const double wanted = figure.at<std::uint8_t>(y, x) / 255., p = probabilityOf(y, x);
        const double by_probability = (2 * both + 1) / (sum * sum) - 2 * wanted / sum;
        (*gradient)[pageLogitIndex(y, x)] +=
            static_cast<float>(scale * ((p - wanted) / pixels + by_probability * p * (1 - p)));
      }
  return entropy / pixels + dice;
}

}  // namespace skel
