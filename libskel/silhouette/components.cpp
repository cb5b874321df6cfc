#include "libskel/silhouette/components.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace skel {

std::vector<Component> componentsOf(const cv::Mat& mask, int connectivity, cv::Mat& labels) {
  std::vector<Component> components(
      static_cast<std::size_t>(cv::connectedComponents(mask, labels, connectivity, CV_32S)));
  for (int y = 0; y < mask.rows; ++y) {
    const int* label = labels.ptr<int>(y);
    for (int x = 0; x < mask.cols;) {
      const int own = label[x], first = x;
      while (x < mask.cols && label[x] == own) ++x;
      if (own == 0) continue;
      Component& c = components[static_cast<std::size_t>(own)];
      const int count = x - first;
      const cv::Rect box = cv::Rect(c.x, c.y, c.width, c.height) | cv::Rect(first, y, count, 1);
      c.x = box.x, c.y = box.y, c.width = box.width, c.height = box.height;
      c.area += count;
      c.centre_x += (first + x - 1) / 2. * count;
      c.centre_y += static_cast<double>(y) * count;
    }
  }
  for (Component& c : components) c.centre_x /= std::max(1, c.area), c.centre_y /= std::max(1, c.area);
  return components;
}

int largestOf(const std::vector<Component>& components) {
  const auto largest =
      std::max_element(components.begin(), components.end(),
                       [](const Component& a, const Component& b) { return a.area < b.area; });
  return static_cast<int>(largest - components.begin());
}

}  // namespace skel
