#include "libskel/silhouette/chambers.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace skel {
namespace {

enum class Side : std::uint8_t { kOpen, kOutside, kInside };

// Regions that grow and unite while the flood sinks.
struct Regions {
  std::vector<int> parent;
  std::vector<float> summit;  // distance to the barrier at the widest place
  std::vector<Side> side;

  int add(float height, Side s) {
    parent.push_back(static_cast<int>(parent.size()));
    summit.push_back(height);
    side.push_back(s);
    return parent.back();
  }
  int find(int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  // `into` keeps its side.
  void unite(int from, int into) {
    parent[from] = into;
    summit[into] = std::max(summit[into], summit[from]);
  }
};

}  // namespace

void fillChambers(cv::Mat& picture, const ChamberOptions& options) {
  const int long_side = std::max(picture.cols, picture.rows);
  const double max_gap = options.max_gap * long_side;
  // Beside all of the barrier it only gets wider; farther away than any gap that counts, all is outside.
  const int beyond = static_cast<int>(max_gap) + 2;
  const cv::Rect box = cv::boundingRect(picture);
  if (box.empty()) return;
  cv::Mat barrier = picture((box + cv::Size(2 * beyond, 2 * beyond) - cv::Point(beyond, beyond)) &
                            cv::Rect({}, picture.size()));
  // A frame one pixel wide stands for the outside.
  cv::Mat open;
  cv::copyMakeBorder(barrier == 0, open, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(255));
  cv::Mat distance;
  cv::distanceTransform(open, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  const int w = distance.cols, h = distance.rows;
  const float* height = distance.ptr<float>();

  // Pixels from the widest place to the narrowest, in steps of a quarter pixel (counting sort).
  constexpr float kStepsPerPixel = 4;
  const int pixel_count = w * h;
  const auto stepOf = [&](int p) { return static_cast<int>(height[p] * kStepsPerPixel); };
  double greatest = 0;
  cv::minMaxLoc(distance, nullptr, &greatest);
  const int max_step = static_cast<int>(static_cast<float>(greatest) * kStepsPerPixel);
  std::vector<int> begin(static_cast<std::size_t>(max_step) + 2, 0);
  for (int p = 0; p < pixel_count; ++p) ++begin[static_cast<std::size_t>(max_step - stepOf(p)) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<int> order(static_cast<std::size_t>(begin[static_cast<std::size_t>(max_step)]));
  for (int p = 0; p < pixel_count; ++p) {
    if (height[p] == 0) continue;
    order[static_cast<std::size_t>(begin[static_cast<std::size_t>(max_step - stepOf(p))]++)] = p;
  }

  Regions regions;
  constexpr int kNone = -1;
  std::vector<int> region(static_cast<std::size_t>(pixel_count), kNone);
  const int outside = regions.add(static_cast<float>(w + h), Side::kOutside);
  for (int x = 0; x < w; ++x) region[x] = region[(h - 1) * w + x] = outside;
  for (int y = 0; y < h; ++y) region[y * w] = region[y * w + w - 1] = outside;

  for (const int p : order) {
    if (region[p] != kNone) continue;
    int mine = kNone;
    for (const int step : {-w, -1, 1, w}) {
      if (region[p + step] == kNone) continue;
      const int other = regions.find(region[p + step]);
      if (mine == kNone) {
        mine = other;
        continue;
      }
      if (other == mine) continue;
      // Two regions meet; `pass` is half the width of the gap between them.
      const float pass = height[p];
      int a = mine, b = other;
      if (regions.side[a] == Side::kOpen) std::swap(a, b);
      if (regions.side[b] != Side::kOpen) continue;  // outside and inside meet: the line between them stays
      if (regions.side[a] == Side::kOutside && pass <= max_gap &&
          regions.summit[b] >= options.widening * pass) {
        regions.side[b] = Side::kInside;
        continue;
      }
      regions.unite(b, a);
      mine = a;
    }
    region[p] = mine == kNone ? regions.add(height[p], Side::kOpen) : mine;
  }

  // A mended outline has the figure on one side and the outside on the other. What lies between limbs is
  // bordered by lines with the figure behind them, and stays outside however narrow the way in is.
  const int reach = std::max(3, static_cast<int>(options.max_stroke * long_side));
  std::vector<int> facing_outside(regions.parent.size(), 0), facing(regions.parent.size(), 0);
  for (int y = 1; y + 1 < h; ++y) {
    for (int x = 1; x + 1 < w; ++x) {
      const int p = y * w + x;
      if (region[p] == kNone || height[p] >= 1.5f) continue;
      const int own = regions.find(region[p]);
      if (regions.side[own] != Side::kInside) continue;
      for (const int step : {-w, -1, 1, w}) {
        if (region[p + step] != kNone) continue;
        int q = p + step, length = 0;
        while (length < reach && region[q] == kNone) q += step, ++length;
        ++facing[own];
        facing_outside[own] += region[q] != kNone && regions.side[regions.find(region[q])] == Side::kOutside;
      }
    }
  }
  for (std::size_t r = 0; r < regions.parent.size(); ++r) {
    if (regions.side[r] == Side::kInside && facing_outside[r] < options.min_facing_outside * facing[r]) {
      regions.side[r] = Side::kOutside;
    }
  }

  for (int y = 0; y < barrier.rows; ++y) {
    std::uint8_t* row = barrier.ptr(y);
    for (int x = 0; x < barrier.cols; ++x) {
      const int r = region[(y + 1) * w + x + 1];
      if (r != kNone && regions.side[regions.find(r)] != Side::kOutside) row[x] = 255;
    }
  }
}

}  // namespace skel
