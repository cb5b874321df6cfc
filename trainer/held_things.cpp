#include "trainer/held_things.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace skel {
namespace {

using Vec = Eigen::Vector2d;

struct Thing {
  cv::Mat rgb, mask;  // CV_8UC3; CV_8U, not 0 on the thing
  Vec grip;           // px
};

constexpr int kThingSize = 128;  // px, the long side of one that is drawn

cv::Scalar someColour(Rng& rng, const PartSample& of) {
  if (rng.chance(.3)) return {rng.uniform(0, 255), rng.uniform(0, 255), rng.uniform(0, 255)};
  std::vector<cv::Point> inside;
  cv::findNonZero(of.mask, inside);
  const cv::Vec3b c = of.rgb.at<cv::Vec3b>(inside[rng.below(static_cast<std::uint32_t>(inside.size()))]);
  return {double(c[0]), double(c[1]), double(c[2])};
}

Thing drawnThing(Rng& rng, const PartSample& colours) {
  const int thick = int(rng.uniform(1, 5)), middle = kThingSize / 2;
  const cv::Scalar fill = someColour(rng, colours),
                   line = rng.chance(.7) ? cv::Scalar::all(rng.uniform(0, 60)) : someColour(rng, colours);
  Thing thing;
  thing.rgb = cv::Mat(kThingSize, kThingSize, CV_8UC3, cv::Scalar::all(255));
  thing.mask = cv::Mat(kThingSize, kThingSize, CV_8U, cv::Scalar(0));
  const bool outlined = rng.chance(.7);
  const auto polygon = [&](const std::vector<cv::Point>& corners, const cv::Scalar& colour) {
    cv::fillPoly(thing.rgb, std::vector{corners}, colour);
    cv::fillPoly(thing.mask, std::vector{corners}, cv::Scalar(255));
    if (!outlined) return;
    cv::polylines(thing.rgb, std::vector{corners}, true, line, thick);
    cv::polylines(thing.mask, std::vector{corners}, true, cv::Scalar(255), thick);
  };
  const auto ellipse = [&](const cv::Point& centre, const cv::Size& axes, const cv::Scalar& colour) {
    std::vector<cv::Point> corners;
    cv::ellipse2Poly(centre, axes, 0, 0, 360, 12, corners);
    polygon(corners, colour);
  };
  const auto bar = [&](int half, int from, int to, const cv::Scalar& colour) {
    polygon({{middle - half, from}, {middle + half, from}, {middle + half, to}, {middle - half, to}}, colour);
  };
  const int kind = int(rng.below(4));
  const int half = kind == 0 ? int(rng.uniform(1, 7)) : int(rng.uniform(12, 56));
  const int low = kThingSize - 6;
  if (kind == 0) {  // a stick, perhaps with something at its end
    bar(half, 6, low, fill);
    if (rng.chance(.6)) {
      const int wide = int(rng.uniform(8, 40)), high = int(rng.uniform(8, 30));
      if (rng.chance(.5))
        ellipse({middle, 8 + high}, {wide, high}, someColour(rng, colours));
      else
        polygon({{middle, 4},
                 {middle + wide, 4 + 2 * high},
                 {middle - (rng.chance(.5) ? wide : 0), 4 + 2 * high}},
                someColour(rng, colours));
    }
    thing.grip = Vec(middle, rng.uniform(40, low));
  } else if (kind == 1) {  // a ball, a bag
    ellipse({middle, middle}, {half, int(rng.uniform(20, 56))}, fill);
    thing.grip = Vec(middle + rng.uniform(-1, 1) * half, rng.uniform(20, 100));
  } else if (kind == 2) {  // a box, a book
    bar(half, 10, low, fill);
    for (int stripes = int(rng.below(3)); stripes > 0; --stripes) {
      const int at = int(rng.uniform(14, low - 14));
      cv::rectangle(thing.rgb, {middle - half, at}, {middle + half, at + int(rng.uniform(1, 12))},
                    someColour(rng, colours), -1);
    }
    thing.grip = Vec(middle + rng.uniform(-1, 1) * half, rng.uniform(10, low));
  } else {  // anything
    std::vector<cv::Point> corners;
    const int count = 3 + int(rng.below(8));
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count, r = rng.uniform(16, 58);
      corners.emplace_back(int(middle + r * std::cos(angle)), int(middle + r * std::sin(angle)));
    }
    polygon(corners, fill);
    thing.grip = Vec(corners[0].x, corners[0].y);
  }
  return thing;
}

// What the other figure holds, or all of it; empty where it holds nothing of some size.
Thing takenThing(Rng& rng, const PartSample& other, bool whole) {
  cv::Mat on = other.mask;
  if (!whole) {
    cv::Mat labels, stats, centres;
    const int count =
        cv::connectedComponentsWithStats(other.part == int(Part::kThing), labels, stats, centres);
    int largest = 0;
    for (int i = 1; i < count; ++i)
      if (largest == 0 || stats.at<int>(i, cv::CC_STAT_AREA) > stats.at<int>(largest, cv::CC_STAT_AREA))
        largest = i;
    constexpr int kLeastArea = 150;  // px
    if (largest == 0 || stats.at<int>(largest, cv::CC_STAT_AREA) < kLeastArea) return {};
    on = labels == largest;
  }
  const cv::Rect box = cv::boundingRect(on);
  Thing thing{other.rgb(box).clone(), on(box).clone(), Vec::Zero()};
  std::vector<cv::Point> inside;
  cv::findNonZero(thing.mask, inside);
  // Held where its own figure held it, if that is known.
  const cv::Point some = inside[rng.below(static_cast<std::uint32_t>(inside.size()))];
  thing.grip = Vec(some.x, some.y);
  if (!whole) {
    double nearest = .1 * std::max(other.mask.rows, other.mask.cols);
    for (int k = 0; k < 2; ++k)
      for (const cv::Point& p : inside)
        if (const double d = (other.skeleton.limbs[std::size_t(k)][2] - Vec(p.x + box.x, p.y + box.y)).norm();
            d < nearest)
          nearest = d, thing.grip = Vec(p.x, p.y);
  }
  return thing;
}

// Ranks of order from 1 on without gaps, 0 where there is no figure; the highest.
int closeRanks(PartSample& sample) {
  std::map<int, int> ranks;
  for (auto p = sample.order.begin<std::uint16_t>(); p != sample.order.end<std::uint16_t>(); ++p)
    ranks[*p] = 0;
  int next = 1;
  for (auto& [order, rank] : ranks) rank = next++;
  for (int y = 0; y < sample.order.rows; ++y)
    for (int x = 0; x < sample.order.cols; ++x) {
      auto& order = sample.order.at<std::uint16_t>(y, x);
      order = sample.mask.at<std::uint8_t>(y, x) == 0 ? std::uint16_t(0) : std::uint16_t(ranks[order]);
    }
  return next - 1;
}

enum class Place { kBefore, kInHand, kBehind };

void lay(Rng& rng, const Thing& thing, const Vec& at, int arm, Place place, PartSample& figure) {
  const int side = std::max(figure.mask.rows, figure.mask.cols) / 2;  // of the figure: half is margin
  const double size = side * std::exp(rng.uniform(std::log(.12), std::log(.8))),
               scale = size / std::max(thing.mask.rows, thing.mask.cols);
  const double angle = rng.chance(.6) ? rng.normal(0, .4) : rng.uniform(-std::numbers::pi, std::numbers::pi),
               c = scale * std::cos(angle), s = scale * std::sin(angle);
  const Vec g = thing.grip;
  const cv::Matx23d map(c, -s, at.x() - c * g.x() + s * g.y(), s, c, at.y() - s * g.x() - c * g.y());
  cv::Mat rgb, mask;
  cv::warpAffine(thing.rgb, rgb, map, figure.mask.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::warpAffine(thing.mask, mask, map, figure.mask.size(), cv::INTER_NEAREST);

  const int highest = closeRanks(figure);
  const int mine = place == Place::kBehind ? 0 : highest + 1;
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) {
      auto& order = figure.order.at<std::uint16_t>(y, x);
      const bool of_arm = place == Place::kInHand && figure.part.at<std::uint8_t>(y, x) == int(limbPart(arm));
      const bool covered = figure.mask.at<std::uint8_t>(y, x) != 0 && (place == Place::kBehind || of_arm);
      if (of_arm) order = static_cast<std::uint16_t>(order + highest + 1);
      if (mask.at<std::uint8_t>(y, x) == 0 || covered) continue;
      figure.rgb.at<cv::Vec3b>(y, x) = rgb.at<cv::Vec3b>(y, x);
      figure.mask.at<std::uint8_t>(y, x) = 255;
      figure.part.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(Part::kThing);
      order = static_cast<std::uint16_t>(mine);
    }
}

}  // namespace

PartSample withThings(Rng& rng, const PartSample& sample, const PartSample& other) {
  PartSample out = withMargin(sample, std::max(sample.mask.rows, sample.mask.cols) / 2);
  for (int count = rng.chance(.25) ? 2 : 1; count > 0; --count) {
    Thing thing = rng.chance(.6) ? takenThing(rng, other, rng.chance(.12)) : Thing{};
    if (thing.mask.empty()) thing = drawnThing(rng, other);
    const int arm = rng.chance(.5) ? 1 : 0;
    const auto& bones = out.skeleton.limbs[std::size_t(arm)];
    const bool in_hand = !out.skeleton.animal && rng.chance(.75);
    Vec at = bones[2];
    if (in_hand)  // the hand's joint is the palm, or the wrist
      at += rng.uniform(-.1, .25) * (bones[2] - bones[1]);
    else
      at = out.skeleton.neck() + rng.uniform(-.2, 1.1) * (out.skeleton.pelvis() - out.skeleton.neck()) +
           Vec(rng.normal(0, .12), rng.normal(0, .05)) * std::max(sample.mask.rows, sample.mask.cols);
    const int before = limbsBefore(out)[std::size_t(arm)];
    const double choice = rng.uniform();
    const Place place = in_hand ? (choice < .35                  ? Place::kBefore
                                   : choice < .75 && before != 0 ? Place::kInHand
                                                                 : Place::kBehind)
                                : (choice < .3 ? Place::kBefore : Place::kBehind);
    lay(rng, thing, at, arm, place, out);
  }
  return smallPartSample(out);
}

}  // namespace skel
