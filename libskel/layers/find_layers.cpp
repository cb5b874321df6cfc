#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "libskel/core/segment.h"
#include "libskel/layers/find_parts.h"
#include "libskel/layers/held_things.h"
#include "libskel/layers/layer_map.h"

namespace skel {
namespace {

using Vec = Eigen::Vector2d;

constexpr double kLeastLimb = .004;    // of the figure's pixels
constexpr double kRoot = .5;           // of a limb's first bone: so far it is grown to the body
constexpr double kLeastContact = .06;  // of a limb's border, beyond its root: less is free
constexpr double kLeastDrawn = .55;    // of that contact
constexpr double kContrast = .12;      // of the range of colours: what is drawn
constexpr double kLeastSure = .55;     // mean probability of its pixels
constexpr double kGrown = .4;  // of a limb's border against the body: it is hidden where it is a guess
constexpr double kSeen = .25;  // of an arm's bones beyond its root: of less nothing is seen
constexpr double kEnd = 1.5, kHand = .4;  // from there on a limb's bones, of less its hand stays behind
// Confidence in the end of a limb that is not hidden: as many hands of drawings that nothing was learned from
// lie below as had less than .75 of their heatmap around them (23 in 100).
constexpr double kSure = .85;

// The picture for OpenCV; it must live as long.
struct Look {
  const PixelBox box;
  const double scale;
  const std::array<double, 4> sure;
  const cv::Mat rgb, mask, part;

  explicit Look(PartPicture& p)
      : box(p.box),
        scale(p.scale),
        sure(p.sure),
        rgb(static_cast<int>(p.mask.rows()), static_cast<int>(p.mask.cols()), CV_8UC3, p.rgb.data()),
        mask(rgb.rows, rgb.cols, CV_8U, p.mask.data()),
        part(rgb.rows, rgb.cols, CV_8U, p.part.data()) {}
  cv::Mat of(Part which) const { return (part == static_cast<int>(which)) & mask; }
};

std::optional<PartSkeleton> partSkeleton(const Skeleton& skeleton, const SkeletonTemplate& body_plan) {
  bool complete = knowsParts(body_plan);
  const auto at = [&](int joint) -> Vec {
    const int found = joint < 0 ? -1 : skeleton.find(body_plan.joints[static_cast<std::size_t>(joint)].name);
    complete = complete && found >= 0;
    return found < 0 ? Vec(Vec::Zero())
                     : Vec(skeleton.joints[static_cast<std::size_t>(found)].image + Vec(.5, .5));
  };
  if (!complete) return std::nullopt;
  PartSkeleton out;
  out.head = at(body_plan.head), out.body = at(body_plan.body);
  for (std::size_t k = 0; k < out.limbs.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i) out.limbs[k][i] = at(body_plan.limbs[k].joints[i]);
  const int root = body_plan.find("tail_root"), tail = body_plan.find("tail");
  out.animal = body_plan.from_side && root >= 0 && tail >= 0;
  if (out.animal) out.tail_root = at(root), out.tail = at(tail);
  return complete ? std::optional(out) : std::nullopt;
}

// How strongly colours change within two px of each, 0…255, `others` and their outlines apart.
cv::Mat edges(const Look& picture, const cv::Mat& others) {
  cv::Mat high = picture.rgb.clone(), low = picture.rgb.clone(), apart, channels[3];
  cv::dilate(others, apart, cv::Mat::ones(5, 5, CV_8U));
  high.setTo(cv::Scalar::all(0), apart), low.setTo(cv::Scalar::all(255), apart);
  cv::dilate(high, high, cv::Mat::ones(5, 5, CV_8U));
  cv::erode(low, low, cv::Mat::ones(5, 5, CV_8U));
  cv::split(high - low, channels);
  return cv::max(channels[0], cv::max(channels[1], channels[2]));
}

// Of a limb's border, px.
struct Border {
  // Of it against the rest of the figure; of that with a line or an edge; the same beyond the limb's root.
  int all = 0, against = 0, drawn = 0, beside = 0, beside_drawn = 0;
};

// How far along the limb's bones the nearest point to `p` is: 0 at its root, 1 at the middle joint, 2 at its
// end.
double alongLimb(const std::array<Vec, 3>& bones, const Vec& p) {
  double best = std::numeric_limits<double>::infinity(), along = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec at = nearestOnSegment<Vec>(p, bones[i], bones[i + 1]);
    const double d = (at - p).norm();
    if (d >= best) continue;
    best = d;
    along = double(i) + (at - bones[i]).norm() / std::max(1e-9, (bones[i + 1] - bones[i]).norm());
  }
  return along;
}

// What `others` hold is no border of this limb but of those: a hand on the hip.
Border borderOf(const Look& picture, const PartSkeleton& skeleton, int limb, const cv::Mat& others,
                const cv::Mat& edge, double range) {
  const cv::Mat own = picture.of(limbPart(limb));
  Border border;
  for (int y = 0; y < own.rows; ++y)
    for (int x = 0; x < own.cols; ++x) {
      if (own.at<std::uint8_t>(y, x) == 0) continue;
      bool outside = false, against = false;
      for (const cv::Point& step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
        const cv::Point q = cv::Point(x, y) + step;
        if (q.x < 0 || q.y < 0 || q.x >= own.cols || q.y >= own.rows || picture.mask.at<std::uint8_t>(q) == 0)
          outside = true;
        else if (own.at<std::uint8_t>(q) == 0 && others.at<std::uint8_t>(q) == 0)
          against = true;
      }
      border.all += outside || against;
      if (!against) continue;
      const bool drawn = edge.at<std::uint8_t>(y, x) > kContrast * range;
      ++border.against, border.drawn += drawn;
      const Vec at = Vec(x + .5, y + .5) / picture.scale + Vec(picture.box.x0, picture.box.y0);
      if (alongLimb(skeleton.limbs[static_cast<std::size_t>(limb)], at) < kRoot) continue;
      ++border.beside, border.beside_drawn += drawn;
    }
  return border;
}

// Grown to the body all along, and nothing tells the two apart.
bool isGrown(const Border& border) {
  return border.against >= kGrown * border.all && border.drawn < kLeastDrawn * border.against;
}

// Of the points on a limb's bones from `from` on, 0 at its root and 2 at its end, the share that shows the
// limb.
double seenAlong(const Look& picture, const PartSkeleton& skeleton, int limb, double from) {
  const auto& [a, b, c] = skeleton.limbs[static_cast<std::size_t>(limb)];
  constexpr int kSamples = 16;
  int seen = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double t = from + (2 - from) * i / (kSamples - 1);
    const Vec p = picture.scale * ((t < 1 ? Vec(a + t * (b - a)) : Vec(b + (t - 1) * (c - b))) -
                                   Vec(picture.box.x0, picture.box.y0));
    const cv::Point q(static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y())));
    if (!cv::Rect(cv::Point(), picture.mask.size()).contains(q)) continue;
    seen += picture.mask.at<std::uint8_t>(q) != 0 &&
            picture.part.at<std::uint8_t>(q) == static_cast<int>(limbPart(limb));
  }
  return static_cast<double>(seen) / kSamples;
}

// Whether it is better off as a body of its own: it lies against the rest of the figure, so that it would
// drag that along, what divides the two is drawn, so that neither is torn, and its end goes with it.
bool standsOut(const Look& picture, const PartSkeleton& skeleton, int limb, const Border& border) {
  return cv::countNonZero(picture.of(limbPart(limb))) >= kLeastLimb * cv::countNonZero(picture.mask) &&
         picture.sure[static_cast<std::size_t>(limb)] >= kLeastSure && border.beside > 0 &&
         border.beside >= kLeastContact * border.all && border.beside_drawn >= kLeastDrawn * border.beside &&
         seenAlong(picture, skeleton, limb, kEnd) >= kHand;
}

// What lies before the trunk is nearer than what it hides.
std::vector<int> farLimbs(const SkeletonTemplate& body_plan, const std::array<double, 4>& before) {
  std::vector<int> far;
  if (!body_plan.from_side) return far;
  for (const auto& [a, b] : body_plan.limbPairs())
    far.push_back(1 + (before[std::size_t(b)] > before[std::size_t(a)] ? a : b));
  return far;
}

// To the image's size, borders as smooth as its pixels allow: of each pixel the number that most of its
// neighbours in `small` have, nearer ones more.
Plane8 enlarged(const Look& picture, const cv::Mat& small, const Plane8& mask) {
  Plane8 whole = Plane8::Zero(mask.rows(), mask.cols());
  const PixelBox& box = picture.box;
  struct Between {
    int first, second;
    double share;  // of the second
  };
  const auto between = [&](int at, int count) {
    const double u = (at + .5) * picture.scale - .5, first = std::floor(u);
    const auto clamped = [&](double k) { return static_cast<int>(std::clamp(k, 0., count - 1.)); };
    return Between{clamped(first), clamped(first + 1), u - first};
  };
  std::vector<Between> columns;
  for (int x = 0; x < box.width(); ++x) columns.push_back(between(x, small.cols));
  for (int y = 0; y < box.height(); ++y) {
    const Between row = between(y, small.rows);
    const auto *upper = small.ptr<std::uint8_t>(row.first), *lower = small.ptr<std::uint8_t>(row.second);
    std::uint8_t* out = &whole(y + box.y0, box.x0);
    for (int x = 0; x < box.width(); ++x) {
      const Between& column = columns[static_cast<std::size_t>(x)];
      const std::array<std::uint8_t, 4> value = {upper[column.first], upper[column.second],
                                                 lower[column.first], lower[column.second]};
      out[x] = value[0];
      if (value[0] == value[1] && value[0] == value[2] && value[0] == value[3]) continue;
      const double v = row.share, u = column.share;
      const std::array<double, 4> weight = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
      double most = -1;
      for (std::size_t i = 0; i < 4; ++i) {
        double sum = 0;
        for (std::size_t j = 0; j < 4; ++j) sum += value[j] == value[i] ? weight[j] : 0;
        if (sum > most) most = sum, out[x] = value[i];
      }
    }
  }
  return (mask != 0).select(whole, Plane8::Zero(mask.rows(), mask.cols()));
}

}  // namespace

LayerMap findLayers(const Image& image, const Silhouette& silhouette, const Skeleton& skeleton,
                    const SkeletonTemplate& body_plan, const PartNet& net) {
  LayerMap map;
  const std::optional<PartSkeleton> bones = partSkeleton(skeleton, body_plan);
  if (!bones) return map;
  PartPicture found = findParts(image, silhouette.mask, *bones, net);
  const Look picture(found);
  map.far = farLimbs(body_plan, found.before);
  cv::Mat limbs(picture.part.size(), CV_8U, cv::Scalar(0));
  cv::Mat arms = cv::Mat::zeros(limbs.size(), CV_8U), edge = edges(picture, arms);  // arms that are layers
  for (int k = 0; k < 4; ++k) {
    if (k == 2 && cv::countNonZero(limbs) != 0)
      arms = (limbs != 0) & picture.mask, edge = edges(picture, arms);
    const Border border = borderOf(picture, *bones, k, arms, edge, found.range);
    if (standsOut(picture, *bones, k, border)) {
      limbs.setTo(k + 1, picture.part == static_cast<int>(limbPart(k)));
      continue;
    }
    const TemplateLimb& limb = body_plan.limbs[static_cast<std::size_t>(k)];
    const int end = skeleton.find(body_plan.joints[static_cast<std::size_t>(limb.joints[2])].name);
    if (limb.limb_class == JointClass::kHand &&
        skeleton.joints[static_cast<std::size_t>(end)].confidence < kSure &&
        (seenAlong(picture, *bones, k, .4) < kSeen || isGrown(border)))
      map.hidden.push_back(k + 1);
  }
  map.part = enlarged(picture, picture.part, silhouette.mask);
  if (cv::countNonZero(limbs) == 0) return map;
  map.limb = enlarged(picture, limbs, silhouette.mask);
  giveThingsToLimbs(silhouette, map);
  return map;
}

}  // namespace skel
