#include "libskel/video/outline_distance.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "libskel/core/check.h"
#include "libskel/core/parallel.h"

namespace skel {
namespace {

// Of each pixel to the nearest point of an outline, within the box of all that will be looked up.
class DistanceTo {
 public:
  DistanceTo(const FrameOutline& outline, const cv::Rect& box) : box_(box) {
    cv::Mat far(box.height, box.width, CV_8U, cv::Scalar(255));
    for (const Eigen::Vector2i& p : outline.points) far.at<std::uint8_t>(p.y() - box.y, p.x() - box.x) = 0;
    cv::distanceTransform(far, field_, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  }
  double farthestOf(const FrameOutline& other) const {
    float farthest = 0;
    for (const Eigen::Vector2i& p : other.points)
      farthest = std::max(farthest, field_.at<float>(p.y() - box_.y, p.x() - box_.x));
    return double(farthest);
  }

 private:
  cv::Rect box_;
  cv::Mat field_;
};

cv::Rect boxOf(const FrameOutline& outline) {
  if (outline.points.empty()) return {};
  Eigen::Vector2i low = outline.points[0], high = low;
  for (const Eigen::Vector2i& p : outline.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return {low.x(), low.y(), high.x() - low.x() + 1, high.y() - low.y() + 1};
}

double diagonal(const FrameOutline& outline) { return std::hypot(outline.width, outline.height); }

void checkSizes(const FrameOutline& a, const FrameOutline& b) {
  SKEL_CHECK_EQ(a.width, b.width);
  SKEL_CHECK_EQ(a.height, b.height);
}

}  // namespace

FrameOutline outlineOf(const Plane8& mask) {
  FrameOutline outline{int(mask.cols()), int(mask.rows()), {}, 0};
  const auto inside = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < outline.width && y < outline.height && mask(y, x) > 0;
  };
  for (int y = 0; y < outline.height; ++y)
    for (int x = 0; x < outline.width; ++x) {
      if (mask(y, x) == 0) continue;
      ++outline.area_px;
      if (!inside(x - 1, y) || !inside(x + 1, y) || !inside(x, y - 1) || !inside(x, y + 1))
        outline.points.emplace_back(x, y);
    }
  return outline;
}

double hausdorffDistance(const FrameOutline& a, const FrameOutline& b) {
  checkSizes(a, b);
  if (a.points.empty() && b.points.empty()) return 0;
  if (a.points.empty() || b.points.empty()) return diagonal(a);
  const cv::Rect box = boxOf(a) | boxOf(b);
  return std::max(DistanceTo(a, box).farthestOf(b), DistanceTo(b, box).farthestOf(a));
}

Eigen::VectorXd successiveDistances(const std::vector<FrameOutline>& outlines, int threads) {
  const std::size_t count = outlines.size();
  Eigen::VectorXd distances(Eigen::Index(count > 0 ? count - 1 : 0));
  parallelFor(std::size_t(distances.size()), threads, [&](std::size_t i) {
    distances(Eigen::Index(i)) = hausdorffDistance(outlines[i], outlines[i + 1]);
  });
  return distances;
}

Eigen::MatrixXd distanceMatrix(const std::vector<FrameOutline>& outlines, int threads,
                               const std::function<void()>& on_frame) {
  const Eigen::Index n = Eigen::Index(outlines.size());
  Eigen::MatrixXd one_way = Eigen::MatrixXd::Zero(n, n);
  cv::Rect box;
  for (const FrameOutline& outline : outlines) {
    checkSizes(outline, outlines[0]);
    if (!outline.points.empty()) box = box.empty() ? boxOf(outline) : box | boxOf(outline);
  }
  parallelFor(outlines.size(), threads, [&](std::size_t i) {
    const FrameOutline& to = outlines[i];
    if (to.points.empty()) {
      for (Eigen::Index k = 0; k < n; ++k)
        one_way(Eigen::Index(i), k) = outlines[std::size_t(k)].points.empty() ? 0 : diagonal(to);
    } else {
      const DistanceTo distance(to, box);
      for (Eigen::Index k = 0; k < n; ++k)
        one_way(Eigen::Index(i), k) = distance.farthestOf(outlines[std::size_t(k)]);
    }
    if (on_frame) on_frame();
  });
  return one_way.cwiseMax(one_way.transpose());
}

std::vector<int> keyFrames(const Eigen::VectorXd& successive, double threshold, double largest) {
  std::vector<int> keys = {0};
  if (largest <= 0) largest = successive.size() > 0 ? successive.maxCoeff() : 0;
  const int last = int(successive.size());
  for (int i = 1; i < last; ++i)
    if (largest > 0 && successive(i - 1) > threshold * largest) keys.push_back(i);
  if (last > 0) keys.push_back(last);
  return keys;
}

}  // namespace skel
