#include "libskel/silhouette/pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace skel {
namespace {

constexpr int kMostPieces = 40;            // of a picture that are looked at, the largest first
constexpr double kBridgeHalfWidth = .016;  // of the figure's long side
constexpr double kAsTall = .55;   // height against the other's that makes a neighbour a person of its own
constexpr double kAsLarge = .12;  // and its area
constexpr double kBeside = .35;   // the most that neighbours share of the narrower one's width

struct Piece {
  int label, area;
  cv::Rect box;
};

// A speck is nothing.
bool largeEnough(const Piece& piece) {
  constexpr int kMinShortSide = 2, kMinArea = 9;
  return std::min(piece.box.width, piece.box.height) >= kMinShortSide && piece.area >= kMinArea;
}

double shared(int low_a, int high_a, int low_b, int high_b) {
  return std::max(0, std::min(high_a, high_b) - std::max(low_a, low_b)) /
         static_cast<double>(std::max(1, std::min(high_a - low_a, high_b - low_b)));
}

// Whether `b`, the smaller one, is another figure beside `a` rather than a piece of it.
bool standsBeside(const Piece& a, const Piece& b) {
  const double overlap = shared(a.box.x, a.box.br().x, b.box.x, b.box.br().x);
  return overlap < kBeside && b.box.height >= kAsTall * a.box.height && b.area >= kAsLarge * a.area;
}

bool isGround(const Piece& figure, const Piece& b) {
  const double middle = b.box.y + b.box.height / 2.;
  return b.box.width >= 2.5 * b.box.height && middle > figure.box.y + .88 * figure.box.height;
}

class Joiner {
 public:
  Joiner(const cv::Mat& labels, std::vector<Piece> pieces, const PieceOptions& options)
      : labels_(labels), pieces_(std::move(pieces)), options_(options), taken_(pieces_.size(), false) {
    far_ =
        static_cast<int>(std::ceil(std::max(2., options.widest_gap * std::max(labels.cols, labels.rows)))) +
        1;
  }

  // The largest piece that is left, with all that belongs to it.
  JoinedFigure next() {
    const std::size_t first =
        static_cast<std::size_t>(std::find(taken_.begin(), taken_.end(), false) - taken_.begin());
    Piece figure = pieces_[first];
    taken_[first] = true;
    JoinedFigure out;
    out.mask = Plane8::Zero(labels_.rows, labels_.cols);
    paint(out.mask, pieces_[first]);
    distance_ = cv::Mat(labels_.size(), CV_32F, cv::Scalar(1e9));
    measure(out.mask, figure.box);
    while (join(figure, out)) {
    }
    return out;
  }
  bool done() const { return std::find(taken_.begin(), taken_.end(), false) == taken_.end(); }

 private:
  void paint(Plane8& mask, const Piece& piece) const {
    for (int y = piece.box.y; y < piece.box.br().y; ++y) {
      const int* row = labels_.ptr<int>(y);
      for (int x = piece.box.x; x < piece.box.br().x; ++x)
        if (row[x] == piece.label) mask(y, x) = 255;
    }
  }

  // Brings the distances to the figure up to date around what was added to it in `box`, as far as pieces are
  // looked for.
  void measure(Plane8& figure, const cv::Rect& box) {
    const cv::Rect around = (box + cv::Size(2 * far_, 2 * far_) - cv::Point(far_, far_)) &
                            cv::Rect(0, 0, labels_.cols, labels_.rows);
    cv::Mat away, distance;
    cv::bitwise_not(cv::Mat(labels_.size(), CV_8U, figure.data())(around), away);
    cv::distanceTransform(away, distance, cv::DIST_L2, cv::DIST_MASK_5);
    cv::Mat known = distance_(around);
    cv::min(known, distance, known);
  }

  // Takes in the nearest piece that belongs to the figure. False if there is none.
  bool join(Piece& figure, JoinedFigure& out) {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const Piece& p = pieces_[i];
      if (taken_[i] || p.area < options_.smallest_share * figure.area || standsBeside(figure, p) ||
          (options_.leave_ground && isGround(figure, p)) || boxGap(figure, p) > reach(figure, p))
        continue;
      open.push_back(i);
    }
    if (open.empty()) return false;
    double least = 0;
    cv::Point at(-1, -1);
    std::size_t best = 0;
    for (const std::size_t i : open) {
      const Piece& p = pieces_[i];
      for (int y = p.box.y; y < p.box.br().y; ++y) {
        const int* label = labels_.ptr<int>(y);
        const float* d = distance_.ptr<float>(y);
        for (int x = p.box.x; x < p.box.br().x; ++x) {
          if (label[x] != p.label || d[x] > reach(figure, p) || (at.x >= 0 && d[x] >= least)) continue;
          least = d[x];
          at = {x, y};
          best = i;
        }
      }
    }
    if (at.x < 0) return false;
    const Piece& piece = pieces_[best];
    const cv::Point to = nearestPixel(out.mask, at, least);
    paint(out.mask, piece);
    const cv::Rect bridged = bridge(out, at, to, longSide(figure, piece));
    measure(out.mask, bridged | piece.box);
    taken_[best] = true;
    ++out.pieces;
    figure.box |= piece.box;
    figure.area += piece.area;
    return true;
  }

  static double longSide(const Piece& a, const Piece& b) {
    const cv::Rect both = a.box | b.box;
    return std::max(both.width, both.height);
  }
  double reach(const Piece& a, const Piece& b) const {
    return std::max(2., options_.widest_gap * longSide(a, b));
  }
  static double boxGap(const Piece& a, const Piece& b) {
    const int dx = std::max({a.box.x - b.box.br().x, b.box.x - a.box.br().x, 0});
    const int dy = std::max({a.box.y - b.box.br().y, b.box.y - a.box.br().y, 0});
    return std::hypot(dx, dy);
  }

  // The pixel of `mask` nearest to `at`, about `distance` away.
  static cv::Point nearestPixel(const Plane8& mask, cv::Point at, double distance) {
    const int reach = static_cast<int>(std::ceil(1.1 * distance)) + 1;
    cv::Point nearest = at;
    int least = std::numeric_limits<int>::max();
    for (int y = std::max(0, at.y - reach); y < std::min(static_cast<int>(mask.rows()), at.y + reach + 1);
         ++y) {
      for (int x = std::max(0, at.x - reach); x < std::min(static_cast<int>(mask.cols()), at.x + reach + 1);
           ++x) {
        const int squared = (x - at.x) * (x - at.x) + (y - at.y) * (y - at.y);
        if (mask(y, x) == 0 || squared >= least) continue;
        least = squared;
        nearest = {x, y};
      }
    }
    return nearest;
  }

  // Gives the box of what it painted.
  static cv::Rect bridge(JoinedFigure& out, cv::Point a, cv::Point b, double long_side) {
    const double radius = std::max(1., kBridgeHalfWidth * long_side);
    if (out.bridges.size() == 0) out.bridges = Plane8::Zero(out.mask.rows(), out.mask.cols());
    // It reaches into both pieces, so that no notch is left where they are round.
    const Eigen::Vector2d from(a.x, a.y), to(b.x, b.y);
    const Eigen::Vector2d along = (to - from).normalized() * std::min(radius, (to - from).norm());
    const Eigen::Vector2d p = from - along, q = to + along, d = q - p;
    const int x0 = static_cast<int>(std::floor(std::min(p.x(), q.x()) - radius)),
              x1 = static_cast<int>(std::ceil(std::max(p.x(), q.x()) + radius));
    const int y0 = static_cast<int>(std::floor(std::min(p.y(), q.y()) - radius)),
              y1 = static_cast<int>(std::ceil(std::max(p.y(), q.y()) + radius));
    for (int y = std::max(0, y0); y <= std::min<int>(static_cast<int>(out.mask.rows()) - 1, y1); ++y) {
      for (int x = std::max(0, x0); x <= std::min<int>(static_cast<int>(out.mask.cols()) - 1, x1); ++x) {
        const Eigen::Vector2d r = Eigen::Vector2d(x, y) - p;
        const double along_share = d.squaredNorm() > 0 ? r.dot(d) / d.squaredNorm() : 0;
        const double t = std::clamp(along_share, 0., 1.);
        if ((r - t * d).norm() > radius || out.mask(y, x) != 0) continue;
        out.mask(y, x) = out.bridges(y, x) = 255;
      }
    }
    return cv::Rect(cv::Point(x0, y0), cv::Point(x1 + 1, y1 + 1)) &
           cv::Rect(0, 0, static_cast<int>(out.mask.cols()), static_cast<int>(out.mask.rows()));
  }

  const cv::Mat& labels_;
  std::vector<Piece> pieces_;
  PieceOptions options_;
  std::vector<bool> taken_;
  int far_;           // px, beyond which no piece is looked for
  cv::Mat distance_;  // of each pixel to the figure
};

}  // namespace

double openShare(const Plane8& figure) {
  const cv::Mat mask(static_cast<int>(figure.rows()), static_cast<int>(figure.cols()), CV_8U,
                     const_cast<std::uint8_t*>(figure.data()));
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_SIMPLE);
  std::vector<cv::Point> points, hull;
  for (const auto& contour : contours) points.insert(points.end(), contour.begin(), contour.end());
  cv::convexHull(points, hull);
  return 1 - std::min(1.0, cv::countNonZero(mask) / std::max(1.0, cv::contourArea(hull)));
}

std::vector<JoinedFigure> joinPieces(const Plane8& foreground, int min_long_side_px,
                                     const PieceOptions& options) {
  cv::Mat labels, stats, centroids;
  const cv::Mat view(static_cast<int>(foreground.rows()), static_cast<int>(foreground.cols()), CV_8U,
                     const_cast<std::uint8_t*>(foreground.data()));
  const int count = cv::connectedComponentsWithStats(view, labels, stats, centroids, 4, CV_32S);
  std::vector<Piece> pieces;
  for (int label = 1; label < count; ++label) {
    const int* s = stats.ptr<int>(label);
    const Piece piece{label,
                      s[cv::CC_STAT_AREA],
                      {s[cv::CC_STAT_LEFT], s[cv::CC_STAT_TOP], s[cv::CC_STAT_WIDTH], s[cv::CC_STAT_HEIGHT]}};
    if (largeEnough(piece)) pieces.push_back(piece);
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.area > b.area; });
  if (pieces.size() > kMostPieces) pieces.resize(kMostPieces);
  Joiner joiner(labels, pieces, options);
  std::vector<std::pair<int, JoinedFigure>> figures;  // by area
  while (!joiner.done()) {
    JoinedFigure figure = joiner.next();
    cv::Mat mask(labels.size(), CV_8U, figure.mask.data());
    const cv::Rect box = cv::boundingRect(mask);
    constexpr int kMinShortSide = 3, kMinArea = 16;
    if (std::max(box.width, box.height) < min_long_side_px ||
        std::min(box.width, box.height) < kMinShortSide || cv::countNonZero(mask) < kMinArea)
      continue;
    figures.emplace_back(cv::countNonZero(mask), std::move(figure));
  }
  std::stable_sort(figures.begin(), figures.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  // What is much smaller than the largest figure belongs to nothing: a ball, a motion line. A thin stick man
  // has little area, but stands as tall as a person beside the largest, and is no line.
  constexpr int kSmallestShare = 5;
  constexpr double kLeastWidth = 0.2;  // of its height
  const auto boxOf = [](JoinedFigure& figure) {
    return cv::boundingRect(cv::Mat(static_cast<int>(figure.mask.rows()),
                                    static_cast<int>(figure.mask.cols()), CV_8U, figure.mask.data()));
  };
  const int largest_area = figures.empty() ? 0 : figures.front().first;
  const int largest_height = figures.empty() ? 0 : boxOf(figures.front().second).height;
  std::erase_if(figures, [&](auto& figure) {
    if (figure.first * kSmallestShare >= largest_area) return false;
    const cv::Rect box = boxOf(figure.second);
    return box.height < kAsTall * largest_height || box.width < kLeastWidth * box.height;
  });
  if (options.limbs_first && figures.size() > 1) {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < figures.size(); ++i) {
      constexpr double kNone = 0.05, kMost = 0.35;
      order.emplace_back(figures[i].first * std::clamp(openShare(figures[i].second.mask), kNone, kMost), i);
    }
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<JoinedFigure> out;
    for (const auto& [weight, i] : order) out.push_back(std::move(figures[i].second));
    return out;
  }
  std::vector<JoinedFigure> out;
  for (auto& [area, figure] : figures) out.push_back(std::move(figure));
  return out;
}

}  // namespace skel
