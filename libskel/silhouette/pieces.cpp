#include "libskel/silhouette/pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "libskel/image/mask_parts.h"
#include "libskel/silhouette/working_colors.h"

namespace skel {
namespace {

constexpr int kMostPieces = 40;            // of a picture that are looked at, the largest first
constexpr double kBridgeHalfWidth = .016;  // of the figure's long side
constexpr double kAsTall = .55;   // height against the other's that makes a neighbour a person of its own
constexpr double kAsLarge = .12;  // and its area
constexpr double kBeside = .35;   // the most that neighbours share of the narrower one's width

struct Piece {
  std::vector<MaskParts::Run> runs;
  int area = 0;
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
  Joiner(cv::Size size, std::vector<Piece> pieces, const PieceOptions& options)
      : picture_({}, size),
        pieces_(std::move(pieces)),
        options_(options),
        taken_(pieces_.size(), false),
        mask_(Plane8::Zero(size.height, size.width)) {
    far_ =
        static_cast<int>(std::ceil(std::max(2., options.widest_gap * std::max(size.width, size.height)))) + 1;
  }

  // The largest piece that is left, with all that belongs to it.
  JoinedFigure next() {
    const std::size_t first =
        static_cast<std::size_t>(std::find(taken_.begin(), taken_.end(), false) - taken_.begin());
    Piece figure{{}, pieces_[first].area, pieces_[first].box};
    taken_[first] = true;
    JoinedFigure out;
    paint(pieces_[first]);
    unmeasured_ = figure.box;
    while (join(figure, out)) {
    }
    // What is needed of a large picture is a box as large as the figure.
    out.left = painted_.x;
    out.top = painted_.y;
    const auto cut = [&](Plane8& plane) {
      auto block = plane.block(painted_.y, painted_.x, painted_.height, painted_.width);
      Plane8 own = block;
      block = 0;
      return own;
    };
    out.mask = cut(mask_);
    if (bridged_) out.bridges = cut(bridges_);
    painted_ = {};
    bridged_ = false;
    distance_.release();
    window_ = {};
    return out;
  }
  bool done() const { return std::find(taken_.begin(), taken_.end(), false) == taken_.end(); }

 private:
  void paint(const Piece& piece) {
    for (const MaskParts::Run& run : piece.runs) mask_.row(run.y).segment(run.x0, run.x1 - run.x0) = 255;
    painted_ |= piece.box;
  }

  // Brings the distances to the figure up to date around what was added to it, as far as pieces are looked
  // for.
  void measure() {
    if (unmeasured_.empty()) return;
    const cv::Rect around = (unmeasured_ + cv::Size(2 * far_, 2 * far_) - cv::Point(far_, far_)) & picture_;
    unmeasured_ = {};
    cv::Mat distance;
    {
      cv::Mat away;
      cv::bitwise_not(cv::Mat(picture_.size(), CV_8U, mask_.data())(around), away);
      cv::distanceTransform(away, distance, cv::DIST_L2, cv::DIST_MASK_5);
    }
    const cv::Rect window = window_ | around;
    if (window == around && window_.empty()) {
      distance_ = distance;
    } else {
      if (window != window_) {
        cv::Mat wider(window.size(), CV_32F, cv::Scalar(kFarAway));
        distance_.copyTo(wider(window_ - window.tl()));
        distance_ = wider;
      }
      cv::Mat known = distance_(around - window.tl());
      cv::min(known, distance, known);
    }
    window_ = window;
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
    measure();
    double least = 0;
    cv::Point at(-1, -1);
    std::size_t best = 0;
    for (const std::size_t i : open) {
      const Piece& p = pieces_[i];
      const double most = reach(figure, p);
      for (const MaskParts::Run& run : p.runs) {
        if (run.y < window_.y || run.y >= window_.br().y) continue;
        const float* d = distance_.ptr<float>(run.y - window_.y);
        const int end = std::min(run.x1, window_.br().x);
        for (int x = std::max(run.x0, window_.x); x < end; ++x) {
          const float away = d[x - window_.x];
          if (away > most || (at.x >= 0 && away >= least)) continue;
          least = away;
          at = {x, run.y};
          best = i;
        }
      }
    }
    if (at.x < 0) return false;
    const Piece& piece = pieces_[best];
    const cv::Point to = nearestPixel(mask_, at, least);
    paint(piece);
    const cv::Rect bridged = bridge(at, to, longSide(figure, piece));
    painted_ |= bridged;
    unmeasured_ = bridged | piece.box;
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
  cv::Rect bridge(cv::Point a, cv::Point b, double long_side) {
    const double radius = std::max(1., kBridgeHalfWidth * long_side);
    if (bridges_.size() == 0) bridges_ = Plane8::Zero(mask_.rows(), mask_.cols());
    bridged_ = true;
    // It reaches into both pieces, so that no notch is left where they are round.
    const Eigen::Vector2d from(a.x, a.y), to(b.x, b.y);
    const Eigen::Vector2d along = (to - from).normalized() * std::min(radius, (to - from).norm());
    const Eigen::Vector2d p = from - along, q = to + along, d = q - p;
    const int x0 = static_cast<int>(std::floor(std::min(p.x(), q.x()) - radius)),
              x1 = static_cast<int>(std::ceil(std::max(p.x(), q.x()) + radius));
    const int y0 = static_cast<int>(std::floor(std::min(p.y(), q.y()) - radius)),
              y1 = static_cast<int>(std::ceil(std::max(p.y(), q.y()) + radius));
    for (int y = std::max(0, y0); y <= std::min<int>(static_cast<int>(mask_.rows()) - 1, y1); ++y) {
      for (int x = std::max(0, x0); x <= std::min<int>(static_cast<int>(mask_.cols()) - 1, x1); ++x) {
        const Eigen::Vector2d r = Eigen::Vector2d(x, y) - p;
        const double along_share = d.squaredNorm() > 0 ? r.dot(d) / d.squaredNorm() : 0;
        const double t = std::clamp(along_share, 0., 1.);
        if ((r - t * d).norm() > radius || mask_(y, x) != 0) continue;
        mask_(y, x) = bridges_(y, x) = 255;
      }
    }
    return cv::Rect(cv::Point(x0, y0), cv::Point(x1 + 1, y1 + 1)) &
           cv::Rect(0, 0, static_cast<int>(mask_.cols()), static_cast<int>(mask_.rows()));
  }

  static constexpr float kFarAway = 1e9f;

  const cv::Rect picture_;
  std::vector<Piece> pieces_;
  PieceOptions options_;
  std::vector<bool> taken_;
  int far_;                // px, beyond which no piece is looked for
  Plane8 mask_, bridges_;  // of the figure that is being joined; 0 outside of painted_
  bool bridged_ = false;
  cv::Rect painted_, unmeasured_;
  cv::Mat distance_;  // of each pixel of window_ to the figure; only where a second piece is looked for
  cv::Rect window_;
};

// In order of area, those that are no specks.
std::vector<Piece> piecesOf(const Plane8& foreground) {
  MaskParts parts = maskParts(foreground);
  std::vector<cv::Rect> boxes(parts.size.size());
  for (const MaskParts::Run& run : parts.runs) boxes[run.part] |= cv::Rect(run.x0, run.y, run.x1 - run.x0, 1);
  std::vector<Piece> pieces;
  std::vector<int> parts_of_pieces;
  for (std::size_t part = 0; part < boxes.size(); ++part) {
    Piece piece{{}, static_cast<int>(parts.size[part]), boxes[part]};
    if (!largeEnough(piece)) continue;
    pieces.push_back(std::move(piece));
    parts_of_pieces.push_back(static_cast<int>(part));
  }
  std::vector<std::size_t> order(pieces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return pieces[a].area > pieces[b].area; });
  if (order.size() > kMostPieces) order.resize(kMostPieces);
  std::vector<int> place(boxes.size(), -1);  // of a part among the pieces
  std::vector<Piece> largest;
  for (const std::size_t i : order) {
    place[parts_of_pieces[i]] = static_cast<int>(largest.size());
    largest.push_back(std::move(pieces[i]));
  }
  for (const MaskParts::Run& run : parts.runs)
    if (place[run.part] >= 0) largest[place[run.part]].runs.push_back(run);
  return largest;
}

}  // namespace

Plane8 JoinedFigure::inPicture(const Plane8& own, Eigen::Index height, Eigen::Index width) const {
  if (own.size() == 0) return {};
  Plane8 whole = Plane8::Zero(height, width);
  whole.block(top, left, own.rows(), own.cols()) = own;
  return whole;
}

double openShare(const Plane8& figure) {
  const cv::Mat mask = viewOf(figure);
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_SIMPLE);
  std::vector<cv::Point> points, hull;
  for (const auto& contour : contours) points.insert(points.end(), contour.begin(), contour.end());
  cv::convexHull(points, hull);
  return 1 - std::min(1.0, cv::countNonZero(mask) / std::max(1.0, cv::contourArea(hull)));
}

std::vector<JoinedFigure> joinPieces(const Plane8& foreground, int min_long_side_px,
                                     const PieceOptions& options) {
  Joiner joiner(cv::Size(static_cast<int>(foreground.cols()), static_cast<int>(foreground.rows())),
                piecesOf(foreground), options);
  std::vector<std::pair<int, JoinedFigure>> figures;  // by area
  while (!joiner.done()) {
    JoinedFigure figure = joiner.next();
    const cv::Mat mask(static_cast<int>(figure.mask.rows()), static_cast<int>(figure.mask.cols()), CV_8U,
                       figure.mask.data());
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
