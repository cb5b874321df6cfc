#include "libskel/silhouette/components.h"

#include <opencv2/imgproc.hpp>

namespace skel {

int Components::largest() const {
  int best = 0;
  for (int i = 1; i < static_cast<int>(of.size()); ++i)
    if (of[static_cast<std::size_t>(i)].area > of[static_cast<std::size_t>(best)].area) best = i;
  return best;
}

Components componentsOf(const cv::Mat& mask, int connectivity) {
  Components out;
  out.of.resize(static_cast<std::size_t>(cv::connectedComponents(mask, out.labels, connectivity, CV_32S)));
  for (int y = 0; y < mask.rows; ++y) {
    const int* label = out.labels.ptr<int>(y);
    for (int x = 0; x < mask.cols;) {
      const int own = label[x], first = x;
      while (x < mask.cols && label[x] == own) ++x;
      if (own == 0) continue;
      Component& component = out.of[static_cast<std::size_t>(own)];
      const int count = x - first;
      component.area += count;
      component.box |= cv::Rect(first, y, count, 1);
      component.centre += cv::Point2d((first + x - 1) / 2. * count, static_cast<double>(y) * count);
    }
  }
  for (std::size_t i = 1; i < out.of.size(); ++i) out.of[i].centre /= static_cast<double>(out.of[i].area);
  return out;
}

}  // namespace skel
