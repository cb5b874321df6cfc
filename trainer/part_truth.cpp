#include "trainer/part_truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "libskel/core/segment.h"

namespace skel {
namespace {

using Vec = Eigen::Vector2d;

// All lengths as shares of the figure's long side.
constexpr double kArmRadius = .055, kLegRadius = .07, kAnimalRadius = .06;
constexpr double kFar = .05;         // beyond all that bones reach
constexpr double kUndecided = .012;  // two parts as near as that
constexpr double kHandReach = .05;   // from the joint, for what is held
// Shares of a shape.
constexpr double kMostly = .72, kCovered = .35;
constexpr double kSmall = .012, kEnclosed = .6;          // of the figure; of its border
constexpr double kHangs = .2;                            // below the neck, of hair that hangs
constexpr double kMostUnknown = .12, kLeastTrunk = .04;  // of the figure

constexpr int kBones = 7;  // parts that have some: trunk, head, four limbs, tail
constexpr std::array<Part, kBones> kOfBone = {Part::kTrunk,   Part::kHead,     Part::kRightArm,
                                              Part::kLeftArm, Part::kRightLeg, Part::kLeftLeg,
                                              Part::kAppendix};
using Distances = std::array<double, kBones>;  // beyond what is surely of a bone; negative within

double toChain(const Vec& p, const std::array<Vec, 3>& chain) {
  return std::min(distanceToSegment<Vec>(p, chain[0], chain[1]),
                  distanceToSegment<Vec>(p, chain[1], chain[2]));
}

class Bones {
 public:
  Bones(const PartSkeleton& skeleton, double unit) : s_(skeleton), unit_(unit) {
    for (const int k : {0, 1, 3, 2}) corners_.emplace_back(cv::Point2f(float(at(k).x()), float(at(k).y())));
    head_ = skeleton.animal ? .08 * unit : .55 * (skeleton.head - skeleton.neck()).norm();
  }
  double radius(int limb) const {
    return unit_ * (s_.animal ? kAnimalRadius : limb < 2 ? kArmRadius : kLegRadius);
  }
  double toLimb(const Vec& p, int limb) const { return toChain(p, s_.limbs[std::size_t(limb)]); }
  Distances of(const Vec& p) const {
    Distances d;
    const Vec neck = s_.neck(), pelvis = s_.pelvis();
    const double spine =
        std::min(distanceToSegment<Vec>(p, neck, s_.body), distanceToSegment<Vec>(p, s_.body, pelvis));
    if (s_.animal) {
      d[0] =
          std::min(spine - .1 * unit_, distanceToSegment<Vec>(p, neck, (neck + s_.head) / 2) - .05 * unit_);
    } else {
      const double box = -cv::pointPolygonTest(corners_, cv::Point2f(float(p.x()), float(p.y())), true);
      d[0] = std::min(box, spine - .06 * unit_);
    }
    d[1] = (p - s_.head).norm() - head_;
    for (int k = 0; k < 4; ++k) d[std::size_t(2 + k)] = toLimb(p, k) - .6 * radius(k);
    d[6] = s_.animal ? distanceToSegment<Vec>(p, s_.tail_root, s_.tail) - .02 * unit_
                     : std::numeric_limits<double>::infinity();
    return d;
  }

 private:
  const Vec& at(int limb) const { return s_.limbs[std::size_t(limb)][0]; }
  const PartSkeleton& s_;
  double unit_, head_ = 0;
  std::vector<cv::Point2f> corners_;
};

struct Shape {
  int place = 0;
  bool line = false;
  std::vector<cv::Point> px;
  std::array<int, 4> close{}, covered{};
  std::array<double, 4> distance{};
  std::array<int, kBones> nearest{};
  int far = 0;
  std::map<int, int> beside;  // px of its border, by the place of the shape there
};

class Divider {
 public:
  Divider(const cv::Mat& shapes, const PartSkeleton& skeleton)
      : skeleton_(skeleton), place_(shapes.size(), CV_16U, cv::Scalar(0)) {
    std::map<int, Shape> by_place;
    cv::Rect box;
    for (int y = 0; y < shapes.rows; ++y)
      for (int x = 0; x < shapes.cols; ++x) {
        const auto& c = shapes.at<cv::Vec3b>(y, x);
        const int place = c[0] + 256 * c[1];
        if (place == 0) continue;
        place_.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(place);
        Shape& shape = by_place[place];
        shape.place = place;
        shape.line = c[2] > 127;
        shape.px.emplace_back(x, y);
        box |= cv::Rect(x, y, 1, 1);
        ++area_;
      }
    unit_ = std::max(box.width, box.height);
    for (auto& [place, shape] : by_place) shapes_.push_back(std::move(shape));
  }

  std::optional<PartTruth> divide() {
    if (area_ == 0) return std::nullopt;
    const Bones bones(skeleton_, unit_);
    for (Shape& shape : shapes_) look(shape, bones);
    PartTruth truth{cv::Mat(place_.size(), CV_8U, cv::Scalar(kNoPart)), place_};
    for (const Shape& shape : shapes_) paint(shape, bones, truth.part);
    fillDetails(truth.part);
    const int unknown = cv::countNonZero(truth.part == kNoPart) - (int(truth.part.total()) - area_),
              trunk = cv::countNonZero(truth.part == int(Part::kTrunk));
    if (unknown > kMostUnknown * area_ || trunk < kLeastTrunk * area_) return std::nullopt;
    return truth;
  }

 private:
  static constexpr std::uint8_t kDetail = 254;  // to be filled with what is around

  static Vec centre(const cv::Point& p) { return {p.x + .5, p.y + .5}; }
  int placeAt(const Vec& p) const {
    const cv::Point at(int(std::floor(p.x())), int(std::floor(p.y())));
    return cv::Rect(cv::Point(), place_.size()).contains(at) ? place_.at<std::uint16_t>(at) : 0;
  }

  void look(Shape& shape, const Bones& bones) const {
    for (const cv::Point& p : shape.px) {
      const Distances d = bones.of(centre(p));
      const auto best = std::min_element(d.begin(), d.end()) - d.begin();
      ++shape.nearest[std::size_t(best)];
      shape.far += d[std::size_t(best)] > kFar * unit_;
      for (int k = 0; k < 4; ++k) {
        const double to = bones.toLimb(centre(p), k);
        shape.close[std::size_t(k)] += to <= bones.radius(k);
        shape.distance[std::size_t(k)] += to / double(shape.px.size());
      }
      for (const cv::Point& step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
        const cv::Point q = p + step;
        const int other = cv::Rect(cv::Point(), place_.size()).contains(q) ? place_.at<std::uint16_t>(q) : 0;
        if (other != shape.place) ++shape.beside[other];
      }
    }
    constexpr int kSamples = 12;
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < kSamples; ++i) {
        const auto& [a, b, c] = skeleton_.limbs[std::size_t(k)];
        const double t = .3 + 1.7 * i / (kSamples - 1);
        const Vec p = t < 1 ? Vec(a + t * (b - a)) : Vec(b + (t - 1) * (c - b));
        shape.covered[std::size_t(k)] += placeAt(p) == shape.place ? 100 / kSamples : 0;
      }
  }

  // The limb whose shape it is, or -1.
  int limbOf(const Shape& shape) const {
    const auto n = double(shape.px.size());
    int best = -1;
    double best_score = 0;
    for (int k = 0; k < 4; ++k) {
      const double close = shape.close[std::size_t(k)] / n, covered = shape.covered[std::size_t(k)] / 100.;
      if (close < kMostly) continue;
      if (shape.nearest[1] > .5 * n) continue;
      if (shape.nearest[0] > .6 * n && covered < kCovered) continue;
      const double score = close + covered - 3 * shape.distance[std::size_t(k)] / unit_;
      if (best < 0 || score > best_score) best = k, best_score = score;
    }
    return best;
  }

  bool spansLegs(const Shape& shape) const {
    if (skeleton_.animal || shape.line) return false;
    const auto n = double(shape.px.size());
    if (n < .03 * area_) return false;
    int asked = 0, inside = 0;
    constexpr int kSamples = 8;
    for (int i = 1; i <= kSamples; ++i) {
      const double t = 1.6 * i / kSamples;
      const auto at = [&](int limb) -> Vec {
        const auto& [a, b, c] = skeleton_.limbs[std::size_t(limb)];
        return t < 1 ? Vec(a + t * (b - a)) : Vec(b + (t - 1) * (c - b));
      };
      const Vec right = at(2), left = at(3);
      if ((right - left).norm() < .05 * unit_) continue;
      const bool right_there = placeAt(right) == shape.place, left_there = placeAt(left) == shape.place;
      if (!right_there && !left_there) continue;
      ++asked;
      inside += right_there && left_there && placeAt((right + left) / 2) == shape.place;
    }
    return asked >= 2 && inside >= .75 * asked && inside >= 2;
  }

  bool touches(const Shape& shape, const Vec& p, double reach) const {
    return std::any_of(shape.px.begin(), shape.px.end(),
                       [&](const cv::Point& q) { return (centre(q) - p).norm() < reach * unit_; });
  }

  bool isDetail(const Shape& shape) const {
    if (shape.line) return true;
    if (double(shape.px.size()) > kSmall * area_) return false;
    int all = 0, most = 0;
    for (const auto& [place, count] : shape.beside) {
      all += count;
      if (place != 0) most = std::max(most, count);
    }
    return most >= kEnclosed * all;
  }

  void paint(const Shape& shape, const Bones& bones, cv::Mat& part) const {
    const auto fill = [&](Part with) {
      for (const cv::Point& p : shape.px) part.at<std::uint8_t>(p) = static_cast<std::uint8_t>(with);
    };
    const auto n = double(shape.px.size());
    const Vec chin = skeleton_.head + .65 * (skeleton_.neck() - skeleton_.head);
    const Vec down = (skeleton_.neck() - skeleton_.head).normalized();
    const auto headOrHair = [&] {
      const auto low = double(std::count_if(shape.px.begin(), shape.px.end(), [&](const cv::Point& p) {
        return (centre(p) - skeleton_.neck()).dot(down) > 0;
      }));
      for (const cv::Point& p : shape.px) {
        const bool hangs = !skeleton_.animal && low > kHangs * n && (centre(p) - chin).dot(down) > 0;
        part.at<std::uint8_t>(p) = static_cast<std::uint8_t>(hangs ? Part::kHair : Part::kHead);
      }
    };
    if (const int limb = limbOf(shape);
        limb >= 0 && !(isDetail(shape) && shape.covered[std::size_t(limb)] < 100 * kCovered))
      return fill(limbPart(limb));
    if (isDetail(shape)) {
      for (const cv::Point& p : shape.px) part.at<std::uint8_t>(p) = kDetail;
      return;
    }
    if (spansLegs(shape)) {
      const Vec axis =
          ((skeleton_.limbs[2][1] + skeleton_.limbs[3][1]) / 2 - skeleton_.pelvis()).normalized();
      for (const cv::Point& p : shape.px)
        part.at<std::uint8_t>(p) = static_cast<std::uint8_t>(
            (centre(p) - skeleton_.pelvis()).dot(axis) > -.02 * unit_ ? Part::kSkirt : Part::kTrunk);
      return;
    }
    if (shape.far > .5 * n) {
      if (shape.nearest[1] > .5 * n) return headOrHair();
      for (int k = 0; k < 4; ++k)
        if (touches(shape, skeleton_.limbs[std::size_t(k)][2], kHandReach)) {
          // A large shoe or paw; with arms what is held.
          const bool foot = skeleton_.animal || k >= 2;
          return fill(foot && n < .06 * area_ ? limbPart(k) : foot ? Part::kAppendix : Part::kThing);
        }
      const bool behind = shape.place < .4 * shapes_.back().place;
      return fill(behind && n > .02 * area_ ? Part::kAppendix : Part::kThing);
    }
    if (shape.nearest[1] > kMostly * n) return headOrHair();
    for (int b = 0; b < kBones; ++b)
      if (shape.nearest[std::size_t(b)] > kMostly * n) return fill(kOfBone[std::size_t(b)]);
    for (const cv::Point& p : shape.px) {
      const Distances d = bones.of(centre(p));
      Distances sorted = d;
      std::nth_element(sorted.begin(), sorted.begin() + 1, sorted.end());
      const double least = *std::min_element(d.begin(), d.end());
      if (sorted[1] - least < kUndecided * unit_ && least > 0) continue;
      const auto best = std::size_t(std::min_element(d.begin(), d.end()) - d.begin());
      part.at<std::uint8_t>(p) = static_cast<std::uint8_t>(kOfBone[best]);
    }
  }

  // Eyes, buttons and lines are of the part around them.
  static void fillDetails(cv::Mat& part) {
    cv::Mat open = part >= kDetail, labels, distance;
    cv::distanceTransform(open, distance, labels, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
    std::vector<std::uint8_t> of_label(part.total() + 1, kNoPart);
    for (int y = 0; y < part.rows; ++y)
      for (int x = 0; x < part.cols; ++x)
        if (open.at<std::uint8_t>(y, x) == 0)
          of_label[std::size_t(labels.at<int>(y, x))] = part.at<std::uint8_t>(y, x);
    for (int y = 0; y < part.rows; ++y)
      for (int x = 0; x < part.cols; ++x)
        if (part.at<std::uint8_t>(y, x) == kDetail)
          part.at<std::uint8_t>(y, x) = of_label[std::size_t(labels.at<int>(y, x))];
  }

  const PartSkeleton& skeleton_;
  cv::Mat place_;
  std::vector<Shape> shapes_;
  double unit_ = 1;
  int area_ = 0;
};

}  // namespace

std::optional<PartTruth> partTruth(const cv::Mat& shapes, const PartSkeleton& skeleton) {
  return Divider(shapes, skeleton).divide();
}

}  // namespace skel
