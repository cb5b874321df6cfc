#include "libskel/silhouette/page.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <tuple>
#include <vector>

#include "libskel/silhouette/levels.h"

namespace skel {
namespace {

constexpr int kSize = 320;       // long side of the picture in which sheets are looked for, px
constexpr int kMostLines = 36;   // of which quadrilaterals are made
constexpr double kReach_px = 4;  // beside a line, where the colours within and without are taken
constexpr double kStep_px = 2;   // between the places along a line

// The paper's colour, which is the most frequent one of the lighter half in the middle of the picture.
std::optional<cv::Vec3f> paperColor(const cv::Mat& lab) {
  const cv::Mat middle = lab(cv::Rect(lab.cols / 5, lab.rows / 5, lab.cols * 3 / 5, lab.rows * 3 / 5));
  std::vector<float> lightness;
  for (int y = 0; y < middle.rows; ++y)
    for (int x = 0; x < middle.cols; ++x) lightness.push_back(middle.at<cv::Vec3b>(y, x)[0]);
  const double half = median(lightness);
  constexpr int kBin = 8, kBins = 256 / kBin;
  std::vector<int> count(kBins * kBins, 0);
  const auto bin = [](const cv::Vec3b& p) { return p[1] / kBin * kBins + p[2] / kBin; };
  for (int y = 0; y < middle.rows; ++y) {
    for (int x = 0; x < middle.cols; ++x) {
      const cv::Vec3b& p = middle.at<cv::Vec3b>(y, x);
      if (p[0] >= half) ++count[static_cast<std::size_t>(bin(p))];
    }
  }
  const int best = static_cast<int>(std::max_element(count.begin(), count.end()) - count.begin());
  std::array<std::vector<float>, 3> channels;
  for (int y = 0; y < middle.rows; ++y) {
    for (int x = 0; x < middle.cols; ++x) {
      const cv::Vec3b& p = middle.at<cv::Vec3b>(y, x);
      if (p[0] < half || bin(p) != best) continue;
      for (int c = 0; c < 3; ++c) channels[static_cast<std::size_t>(c)].push_back(p[c]);
    }
  }
  cv::Vec3f color;
  for (int c = 0; c < 3; ++c) color[c] = static_cast<float>(median(channels[static_cast<std::size_t>(c)]));
  constexpr float kDarkest = 100, kMostChroma = 45;
  if (color[0] < kDarkest || std::hypot(color[1] - 128, color[2] - 128) > kMostChroma) return {};
  return color;
}

// Lab with the chroma that the same thing would have in full light: shadows take from both.
cv::Mat inFullLight(const cv::Mat& lab, float lightness) {
  cv::Mat out(lab.size(), CV_32FC3);
  for (int y = 0; y < lab.rows; ++y) {
    const cv::Vec3b* from = lab.ptr<cv::Vec3b>(y);
    cv::Vec3f* to = out.ptr<cv::Vec3f>(y);
    for (int x = 0; x < lab.cols; ++x) {
      const float gain = std::min(3.0f, lightness / std::max(1.0f, static_cast<float>(from[x][0])));
      to[x] = {static_cast<float>(from[x][0]), gain * (static_cast<float>(from[x][1]) - 128),
               gain * (static_cast<float>(from[x][2]) - 128)};
    }
  }
  return out;
}

// A line with paper on the side its normal points to. Points along it are base + t·direction.
struct Side {
  Eigen::Vector2d base, direction, normal;
  std::vector<int> good, inside;  // prefix sums over the places: a sheet's rim; paper within
  double strength = 0;

  double at(const Eigen::Vector2d& p) const { return (p - base).dot(direction) / kStep_px; }
};

class Finder {
 public:
  Finder(const cv::Mat& lab, const cv::Vec3f& paper)
      : colors_(inFullLight(lab, paper[0])), is_paper_(lab.size(), CV_8U) {
    cv::blur(colors_, colors_, cv::Size(3, 3));
    for (int y = 0; y < lab.rows; ++y)
      for (int x = 0; x < lab.cols; ++x) {
        const cv::Vec3f& c = colors_.at<cv::Vec3f>(y, x);
        is_paper_.at<std::uint8_t>(y, x) =
            c[0] > 0.4f * paper[0] && std::hypot(c[1] - (paper[1] - 128), c[2] - (paper[2] - 128)) < 16;
      }
  }

  // Nothing if it is not so strong.
  std::optional<Side> measured(double rho, double theta, double sign, double least_strength) {
    Side side;
    side.normal = sign * Eigen::Vector2d(std::cos(theta), std::sin(theta));
    side.direction = {-side.normal.y(), side.normal.x()};
    const double length = std::hypot(colors_.cols, colors_.rows);
    side.base = sign * rho * side.normal - length * side.direction;
    const int places = static_cast<int>(std::ceil(2 * length / kStep_px));
    rims_.assign(static_cast<std::size_t>(places), 0), papers_.assign(static_cast<std::size_t>(places), 0);
    // Only where the place within lies in the picture, or a px beside it.
    double first = 0, last = places;
    const Eigen::Vector2d inner = side.base + kReach_px * side.normal;
    for (const auto& [from, along, size] : {std::tuple(inner.x(), side.direction.x(), colors_.cols),
                                            std::tuple(inner.y(), side.direction.y(), colors_.rows)}) {
      if (std::abs(along) < 1e-6) continue;
      const auto [enters, leaves] = std::minmax({(-1 - from) / along, (size - from) / along});
      first = std::max(first, enters / kStep_px), last = std::min(last, leaves / kStep_px);
    }
    double run = 0;
    for (int k = static_cast<int>(first); k < last; ++k) {
      const Eigen::Vector2d p = side.base + k * kStep_px * side.direction;
      const std::optional<cv::Point> within = pixel(p + kReach_px * side.normal),
                                     without = pixel(p - kReach_px * side.normal);
      const bool paper = within && is_paper_.at<std::uint8_t>(*within);
      const bool rim =
          paper && without && isOther(colors_.at<cv::Vec3f>(*within), colors_.at<cv::Vec3f>(*without));
      rims_[static_cast<std::size_t>(k)] = rim, papers_[static_cast<std::size_t>(k)] = paper;
      if (!within || !without) continue;
      run = std::max(0.0, run + (rim ? 1.0 : -0.8));
      side.strength = std::max(side.strength, run);
    }
    if (side.strength < least_strength) return {};
    side.good = sumsOf(rims_), side.inside = sumsOf(papers_);
    return side;
  }

 private:
  std::optional<cv::Point> pixel(const Eigen::Vector2d& p) const {
    const int x = cvRound(p.x()), y = cvRound(p.y());
    if (x < 0 || y < 0 || x >= colors_.cols || y >= colors_.rows) return {};
    return cv::Point(x, y);
  }
  static bool isOther(const cv::Vec3f& within, const cv::Vec3f& without) {
    const float darker = within[0] - without[0];
    return darker > 14 || (darker > -20 && std::hypot(within[1] - without[1], within[2] - without[2]) > 12);
  }
  static std::vector<int> sumsOf(const std::vector<std::uint8_t>& places) {
    std::vector<int> sums = {0};
    for (const std::uint8_t place : places) sums.push_back(sums.back() + place);
    return sums;
  }

  cv::Mat colors_, is_paper_;
  std::vector<std::uint8_t> rims_, papers_;  // of the places along a line
};

Eigen::Vector2d crossing(const Side& a, const Side& b) {
  Eigen::Matrix2d m;
  m << a.normal.transpose(), b.normal.transpose();
  return m.inverse() * Eigen::Vector2d(a.normal.dot(a.base), b.normal.dot(b.base));
}

double areaOf(const PageCorners& corners) {
  const Eigen::Vector2d a = corners[2] - corners[0], b = corners[3] - corners[1];
  return std::abs(a.x() * b.y() - a.y() * b.x()) / 2;
}

double shareOf(const std::vector<int>& sums, double from, double to) {
  const auto clamped = [&](double t) {
    return static_cast<std::size_t>(std::clamp(t, 0.0, static_cast<double>(sums.size() - 1)));
  };
  const double count = std::max(1.0, std::floor(to) - std::floor(from));
  return (sums[clamped(to)] - sums[clamped(from)]) / count;
}

}  // namespace

std::optional<PageCorners> findPage(const cv::Mat& lab) {
  const double scale = std::min(1.0, kSize / static_cast<double>(std::max(lab.cols, lab.rows)));
  cv::Mat small;
  cv::resize(lab, small, {}, scale, scale, cv::INTER_AREA);
  if (std::min(small.cols, small.rows) < 60) return {};
  const std::optional<cv::Vec3f> paper = paperColor(small);
  if (!paper) return {};

  cv::Mat edges = cv::Mat::zeros(small.size(), CV_8U);
  for (int c = 0; c < 3; ++c) {
    cv::Mat channel, steep;
    cv::extractChannel(small, channel, c);
    cv::GaussianBlur(channel, channel, cv::Size(5, 5), 1.2);
    cv::Canny(channel, steep, c == 0 ? 25 : 15, c == 0 ? 60 : 35);
    edges |= steep;
  }
  std::vector<cv::Vec2f> lines;
  const int least_votes = std::min(small.cols, small.rows) / 6;
  cv::HoughLines(edges, lines, 1, std::numbers::pi / 180, least_votes);
  constexpr std::size_t kMostMeasured = 1500;
  if (lines.size() > kMostMeasured) lines.resize(kMostMeasured);

  Finder finder(small, *paper);
  std::vector<Side> sides;
  const double least_strength = 0.25 * std::min(small.cols, small.rows) / kStep_px;
  for (const cv::Vec2f& line : lines) {
    for (const double sign : {1.0, -1.0}) {
      std::optional<Side> side = finder.measured(line[0], line[1], sign, least_strength);
      if (side) sides.push_back(std::move(*side));
    }
  }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const Side& a, const Side& b) { return a.strength > b.strength; });
  std::vector<Side> kept;
  const Eigen::Vector2d center(small.cols / 2.0, small.rows / 2.0);
  for (const Side& side : sides) {
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const Side& k) {
      return k.normal.dot(side.normal) > std::cos(2.5 * std::numbers::pi / 180) &&
             std::abs(k.normal.dot(center - k.base) - side.normal.dot(center - side.base)) < 5;
    });
    if (known) continue;
    kept.push_back(side);
    if (kept.size() == kMostLines) break;
  }

  // The sides follow each other clockwise: their inward normals point down, left, up, right.
  std::array<std::vector<const Side*>, 4> facing;
  for (const Side& side : kept) {
    const Eigen::Vector2d& n = side.normal;
    const std::size_t i = std::abs(n.y()) >= std::abs(n.x()) ? (n.y() > 0 ? 0 : 2) : (n.x() < 0 ? 1 : 3);
    facing[i].push_back(&side);
  }
  double best = 0;
  std::optional<PageCorners> found;
  constexpr double kLeastShare = 0.35, kLeastMean = 0.5, kLeastPaper = 0.8, kLeastLong = 0.35,
                   kLeastArea = 0.15;
  for (const Side* top : facing[0])
    for (const Side* right : facing[1])
      for (const Side* bottom : facing[2])
        for (const Side* left : facing[3]) {
          const std::array<const Side*, 4> quad = {top, right, bottom, left};
          PageCorners corners;
          bool whole = true;
          for (std::size_t i = 0; i < 4 && whole; ++i) {
            const Side &before = *quad[(i + 3) % 4], &after = *quad[i];
            whole = std::abs(before.normal.dot(after.normal)) < 0.45;
            if (!whole) break;
            corners[i] = crossing(before, after);
            constexpr double kSlack = 3;
            whole = corners[i].x() > -kSlack && corners[i].y() > -kSlack &&
                    corners[i].x() < small.cols + kSlack && corners[i].y() < small.rows + kSlack;
          }
          if (!whole) continue;
          // Sides that look away from the middle bound what is no sheet.
          const Eigen::Vector2d middle = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
          for (const Side* side : quad) whole = whole && side->normal.dot(middle - side->base) > 0;
          if (!whole || areaOf(corners) < kLeastArea * small.cols * small.rows) continue;
          double sum = 0, length = 0, least = 1;
          for (std::size_t i = 0; i < 4 && whole; ++i) {
            const Side& side = *quad[i];
            const double from = side.at(corners[i]), to = side.at(corners[(i + 1) % 4]);
            const double a = std::min(from, to), b = std::max(from, to);
            const double share = shareOf(side.good, a, b);
            whole = (b - a) * kStep_px > kLeastLong * std::min(small.cols, small.rows) &&
                    share > kLeastShare && shareOf(side.inside, a, b) > kLeastPaper;
            least = std::min(least, share);
            sum += share * (b - a);
            length += b - a;
          }
          if (!whole || sum < kLeastMean * length) continue;
          const double score =
              sum / length + 0.5 * least + 0.3 * length * kStep_px / (small.cols + small.rows);
          if (score <= best) continue;
          best = score;
          found = corners;
        }
  if (!found) return {};
  for (Eigen::Vector2d& corner : *found) corner = ((corner.array() + 0.5) / scale - 0.5).matrix();
  return found;
}

cv::Mat pageFromPicture(const PageCorners& corners, std::array<int, 2>& size) {
  const auto mean = [&](int a, int b, int c, int d) {
    return ((corners[a] - corners[b]).norm() + (corners[c] - corners[d]).norm()) / 2;
  };
  const double width = mean(0, 1, 3, 2), height = mean(0, 3, 1, 2),
               scale = kPageSize / std::max(width, height);
  size = {std::max(1, cvRound(width * scale)), std::max(1, cvRound(height * scale))};
  constexpr float kRim = 0.012f * kPageSize;  // lies outside of what is looked at
  const float w = static_cast<float>(size[0]) - 0.5f + kRim, h = static_cast<float>(size[1]) - 0.5f + kRim;
  const float o = -0.5f - kRim;
  const std::array<cv::Point2f, 4> to = {cv::Point2f(o, o), {w, o}, {w, h}, {o, h}};
  std::array<cv::Point2f, 4> from;
  for (std::size_t i = 0; i < 4; ++i)
    from[i] = {static_cast<float>(corners[i].x()), static_cast<float>(corners[i].y())};
  return cv::getPerspectiveTransform(from, to);
}

}  // namespace skel
