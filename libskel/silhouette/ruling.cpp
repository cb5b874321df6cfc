#include "libskel/silhouette/ruling.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "libskel/silhouette/levels.h"

namespace skel {
namespace {

constexpr int kStrips = 12;
constexpr double kSteepest = 0.2;       // slope of the lines
constexpr double kSlopeStep = 0.02;     // about one pixel in a strip
constexpr int kThickest = 9;            // px, of what closes over a line
constexpr float kLeastDarkness = 1.6f;  // of a line's mean, levels
constexpr std::size_t kFewLines = 8;
constexpr double kMostTimes = 1.7;  // the darkness of a line at its darkest, in terms of its mean

// Darkness of what is thin from top to bottom, cut off where it is as strong as any line of print.
cv::Mat thinDarkness(const cv::Mat& rgb) {
  cv::Mat value(rgb.size(), CV_8U), dark;
  for (int y = 0; y < rgb.rows; ++y) {
    const cv::Vec3b* row = rgb.ptr<cv::Vec3b>(y);
    std::uint8_t* out = value.ptr(y);
    for (int x = 0; x < rgb.cols; ++x)
      out[x] = static_cast<std::uint8_t>((std::min({row[x][0], row[x][1], row[x][2]}) + row[x][1]) / 2);
  }
  cv::morphologyEx(value, dark, cv::MORPH_BLACKHAT, cv::Mat::ones(kThickest, 1, CV_8U));
  constexpr double kStrongest = 40;
  cv::min(dark, kStrongest, dark);
  return dark;
}

// Darkness on every column of the picture, a row each.
cv::Mat columnsOf(const cv::Mat& dark) {
  cv::Mat columns;
  cv::transpose(dark, columns);
  columns.convertTo(columns, CV_32F);
  return columns;
}

// Mean darkness of the strip from x0 to x1 along each line of this slope, by its height at the strip's
// middle.
std::vector<float> profile(const cv::Mat& columns, int x0, int x1, double slope) {
  using Row = Eigen::Array<float, 1, Eigen::Dynamic>;
  const int h = columns.cols, middle = (x0 + x1) / 2;
  std::vector<float> sum(static_cast<std::size_t>(h), 0);
  Eigen::Map<Row> sums(sum.data(), h);
  int count = 0;
  for (int x = x0; x < x1; x += 2, ++count) {
    const int shift = cvRound(slope * (x - middle)), rows = h - std::abs(shift);
    if (rows <= 0) continue;
    const Eigen::Map<const Row> column(columns.ptr<float>(x), h);
    sums.segment(std::max(0, -shift), rows) += column.segment(std::max(0, shift), rows);
  }
  sums /= static_cast<float>(std::max(1, count));
  return sum;
}

double energy(const std::vector<float>& sums) {
  double mean = 0, squares = 0;
  for (const float s : sums) mean += s, squares += static_cast<double>(s) * s;
  mean /= static_cast<double>(sums.size());
  return squares / static_cast<double>(sums.size()) - mean * mean;
}

// Heights at which the profile has a narrow peak.
std::vector<int> peaksOf(const std::vector<float>& sums) {
  std::vector<float> sorted = sums;
  const float level = static_cast<float>(median(sorted));
  for (float& s : sorted) s = std::abs(s - level);
  const float least = std::max(kLeastDarkness, 5 * static_cast<float>(median(sorted)));
  std::vector<int> peaks;
  const int n = static_cast<int>(sums.size());
  for (int y = 2; y + 2 < n; ++y) {
    const float* s = sums.data() + y;
    const float beside = std::min(s[-2], s[2]);
    if (s[0] - level < least || s[0] < s[-1] || s[0] <= s[1] || s[0] - beside < 0.4f * least) continue;
    peaks.push_back(y);
  }
  return peaks;
}

struct Line {
  std::vector<double> heights = std::vector<double>(kStrips, -1);  // at the middle of each strip; -1 not seen
  int seen = 0, first = -1, last = -1;                             // strips
  double height = 0, darkness = 0;                                 // mean
};

// Whether there are many, most of them as far from the next as the others, or twice as far.
bool evenlySpaced(const std::vector<Line>& lines, int height) {
  if (lines.size() < kFewLines) return false;
  std::vector<double> heights;
  for (const Line& line : lines) heights.push_back(line.height);
  std::sort(heights.begin(), heights.end());
  if (2 * (heights.back() - heights.front()) < height) return false;
  std::vector<float> gaps;
  for (std::size_t i = 1; i < heights.size(); ++i)
    gaps.push_back(static_cast<float>(heights[i] - heights[i - 1]));
  std::vector<float> sorted = gaps;
  const double period = median(sorted);
  const auto even = std::count_if(gaps.begin(), gaps.end(), [&](float gap) {
    const double times = std::round(gap / period);
    return times >= 1 && std::abs(gap / period - times) < 0.2;
  });
  return period >= 4 && static_cast<double>(even) >= 0.6 * static_cast<double>(gaps.size());
}

// Lines that run through the picture from left to right.
std::vector<Line> linesIn(const cv::Mat& columns) {
  const int w = columns.rows;
  const auto edge = [&](int strip) { return w * strip / kStrips; };
  double best_slope = 0, most = -1;
  for (double slope = -kSteepest; slope <= kSteepest + 1e-9; slope += kSlopeStep) {
    double sum = 0;
    // A few lines of a drawing are strong, those of paper are many.
    for (int s = 0; s < kStrips; s += 2)
      sum += std::sqrt(energy(profile(columns, edge(s), edge(s + 1), slope)));
    if (sum > most) {
      most = sum;
      best_slope = slope;
    }
  }
  std::vector<std::vector<int>> peaks(kStrips);
  std::vector<std::vector<float>> profiles(kStrips);
  std::vector<double> slopes(kStrips, best_slope);
  for (int s = 0; s < kStrips; ++s) {
    std::vector<float> best;
    double strongest = -1;
    for (int i = -2; i <= 2; ++i) {
      std::vector<float> sums = profile(columns, edge(s), edge(s + 1), best_slope + i * kSlopeStep);
      const double e = energy(sums);
      if (e <= strongest) continue;
      strongest = e;
      best = std::move(sums);
      slopes[static_cast<std::size_t>(s)] = best_slope + i * kSlopeStep;
    }
    peaks[static_cast<std::size_t>(s)] = peaksOf(best);
    profiles[static_cast<std::size_t>(s)] = std::move(best);
  }
  std::vector<Line> lines;
  std::vector<std::vector<bool>> taken(kStrips);
  for (std::size_t s = 0; s < kStrips; ++s) taken[s].assign(peaks[s].size(), false);
  const double strip = static_cast<double>(w) / kStrips;
  for (int start = 0; start < kStrips; ++start) {
    for (std::size_t p = 0; p < peaks[static_cast<std::size_t>(start)].size(); ++p) {
      if (taken[static_cast<std::size_t>(start)][p]) continue;
      Line line;
      double height = peaks[static_cast<std::size_t>(start)][p],
             slope = slopes[static_cast<std::size_t>(start)];
      int at = start;
      std::vector<std::pair<std::size_t, std::size_t>> own;
      for (int s = start; s < kStrips; ++s) {
        const std::size_t i = static_cast<std::size_t>(s);
        const double expected = height + slope * strip * (s - at);
        const double slack = 1.6 + 0.7 * (s - at);
        double nearest = slack;
        std::size_t chosen = peaks[i].size();
        for (std::size_t q = 0; q < peaks[i].size(); ++q) {
          const double d = std::abs(peaks[i][q] - expected);
          if (d <= nearest && !taken[i][q]) nearest = d, chosen = q;
        }
        if (chosen == peaks[i].size()) continue;
        height = peaks[i][chosen];
        if (s > at && line.seen > 0)
          slope += 0.3 * ((height - line.heights[static_cast<std::size_t>(at)]) / (strip * (s - at)) - slope);
        at = s;
        line.heights[i] = height;
        own.emplace_back(i, chosen);
        if (line.first < 0) line.first = s;
        line.last = s;
        ++line.seen;
      }
      if (line.seen < kStrips * 2 / 3) continue;
      for (const auto& [i, q] : own) {
        taken[i][q] = true;
        line.height += peaks[i][q] / static_cast<double>(own.size());
        line.darkness += profiles[i][static_cast<std::size_t>(peaks[i][q])] / static_cast<double>(own.size());
      }
      lines.push_back(std::move(line));
    }
  }
  if (evenlySpaced(lines, columns.cols)) return lines;
  std::erase_if(lines, [](const Line& line) { return line.seen < kStrips - 1; });
  return lines;
}

// Erases level lines and returns them.
std::vector<RuledLine> eraseLevel(cv::Mat& rgb) {
  const std::vector<Line> lines = linesIn(columnsOf(thinDarkness(rgb)));
  if (lines.empty()) return {};
  cv::Mat closed;
  cv::morphologyEx(rgb, closed, cv::MORPH_CLOSE, cv::Mat::ones(kThickest, 1, CV_8U));
  const double strip = static_cast<double>(rgb.cols) / kStrips;
  std::vector<RuledLine> erased;
  for (const Line& line : lines) {
    RuledLine ruled;
    std::vector<Eigen::Vector2d>& points = ruled.points;
    for (std::size_t s = 0; s < kStrips; ++s) {
      if (line.heights[s] >= 0) points.emplace_back((static_cast<double>(s) + 0.5) * strip, line.heights[s]);
    }
    const double most = kMostTimes * line.darkness + 3;
    std::size_t next = 1;
    for (int x = 0; x < rgb.cols; ++x) {
      while (next + 1 < points.size() && points[next].x() < x) ++next;
      const Eigen::Vector2d &a = points[next - 1], &b = points[next];
      const int middle = cvRound(a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x()));
      constexpr int kHalf = 2;
      for (int y = std::max(0, middle - kHalf); y <= std::min(rgb.rows - 1, middle + kHalf); ++y) {
        cv::Vec3b& p = rgb.at<cv::Vec3b>(y, x);
        const cv::Vec3b& c = closed.at<cv::Vec3b>(y, x);
        for (int k = 0; k < 3; ++k) p[k] = static_cast<std::uint8_t>(std::min<double>(c[k], p[k] + most));
      }
    }
    erased.push_back(std::move(ruled));
  }
  return erased;
}

}  // namespace

std::vector<RuledLine> eraseRuling(cv::Mat& rgb) {
  if (std::min(rgb.cols, rgb.rows) < 10 * kStrips) return {};
  std::vector<RuledLine> lines = eraseLevel(rgb);
  cv::Mat turned;
  cv::transpose(rgb, turned);
  const std::vector<RuledLine> upright = eraseLevel(turned);
  if (!upright.empty()) cv::transpose(turned, rgb);
  for (RuledLine line : upright) {
    line.upright = true;
    for (Eigen::Vector2d& p : line.points) p.reverseInPlace();
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace skel
