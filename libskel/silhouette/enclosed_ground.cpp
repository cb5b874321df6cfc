#include "libskel/silhouette/enclosed_ground.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "libskel/core/check.h"
#include "libskel/silhouette/components.h"
#include "libskel/silhouette/working_colors.h"

namespace skel {

std::optional<EnclosedGround> enclosedGround(const Plane8& mask, const Plane8& chance) {
  SKEL_CHECK(mask.size() > 0 && chance.size() > 0);
  const cv::Mat chances = viewOf(chance);
  cv::Mat figure;
  cv::resize(viewOf(mask), figure, chances.size(), 0, 0, cv::INTER_AREA);
  figure = figure >= 128;
  cv::Mat labels;
  const std::vector<Component> pieces = componentsOf(figure & (chances > 0), 4, labels);
  std::vector<double> sums(pieces.size(), 0);
  double sum = 0;
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x)
      if (const int label = labels.at<int>(y, x); label > 0) {
        const double own = chances.at<std::uint8_t>(y, x) / 255.;
        sums[static_cast<std::size_t>(label)] += own;
        sum += own;
      }
  if (sum == 0) return std::nullopt;
  const Component& most =
      pieces[static_cast<std::size_t>(std::max_element(sums.begin(), sums.end()) - sums.begin())];
  const double x = double(mask.cols()) / figure.cols, y = double(mask.rows()) / figure.rows;
  return EnclosedGround{sum / std::max(1, cv::countNonZero(figure)),
                        {most.x * x, most.y * y, most.width * x, most.height * y}};
}

}  // namespace skel
