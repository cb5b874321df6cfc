#include "libskel/layers/limb_evidence.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "libskel/core/check.h"
#include "libskel/layers/limb_bones.h"

namespace skel {
namespace {

using Vec = Eigen::Vector2d;

constexpr double kBeyondRoot = .5;    // of a limb's first bone: so far it is grown to the body
constexpr double kLeastBeside = .06;  // of a limb's border: of less it is free
constexpr double kContrast = .12;     // of the range of colours: what is drawn
constexpr int kStations = 10;         // along the bones, where the width is measured
constexpr double kRagged = .4;        // of the width: of the disc that smooths

// The picture for OpenCV; it must live as long.
struct PartLook {
  const PartPicture& found;
  const cv::Mat rgb, mask, part;

  explicit PartLook(const PartPicture& p)
      : found(p),
        rgb(static_cast<int>(p.mask.rows()), static_cast<int>(p.mask.cols()), CV_8UC3,
            const_cast<std::uint8_t*>(p.rgb.data())),
        mask(rgb.rows, rgb.cols, CV_8U, const_cast<std::uint8_t*>(p.mask.data())),
        part(rgb.rows, rgb.cols, CV_8U, const_cast<std::uint8_t*>(p.part.data())) {}
  cv::Mat of(int limb) const { return (part == static_cast<int>(limbPart(limb))) & mask; }
  Vec toPicture(const Vec& image_px) const {
    return found.scale * (image_px - Vec(found.box.x0, found.box.y0));
  }
};

// How strongly colours change within two px of each, 0…255, `others` and their outlines apart.
cv::Mat edgesOf(const PartLook& look, const cv::Mat& others) {
  cv::Mat high = look.rgb.clone(), low = look.rgb.clone(), apart, channels[3];
  cv::dilate(others, apart, cv::Mat::ones(5, 5, CV_8U));
  high.setTo(cv::Scalar::all(0), apart), low.setTo(cv::Scalar::all(255), apart);
  cv::dilate(high, high, cv::Mat::ones(5, 5, CV_8U));
  cv::erode(low, low, cv::Mat::ones(5, 5, CV_8U));
  cv::split(high - low, channels);
  return cv::max(channels[0], cv::max(channels[1], channels[2]));
}

LimbBones bonesOf(const PartLook& look, const PartSkeleton& skeleton, int limb) {
  LimbBones bones;
  for (std::size_t i = 0; i < 3; ++i)
    bones.joints[i] = look.toPicture(skeleton.limbs[static_cast<std::size_t>(limb)][i]);
  return bones;
}

// What `others` hold is no border of this limb but of those: a hand on the hip.
LimbBorder borderOf(const PartLook& look, const LimbBones& bones, const cv::Mat& own, const cv::Mat& others,
                    const cv::Mat& edge) {
  LimbBorder border;
  for (int y = 0; y < own.rows; ++y)
    for (int x = 0; x < own.cols; ++x) {
      if (own.at<std::uint8_t>(y, x) == 0) continue;
      bool outside = false, against = false;
      for (const cv::Point& step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
        const cv::Point q = cv::Point(x, y) + step;
        if (q.x < 0 || q.y < 0 || q.x >= own.cols || q.y >= own.rows || look.mask.at<std::uint8_t>(q) == 0)
          outside = true;
        else if (own.at<std::uint8_t>(q) == 0 && others.at<std::uint8_t>(q) == 0)
          against = true;
      }
      border.all += outside || against;
      if (!against) continue;
      const bool drawn = edge.at<std::uint8_t>(y, x) > kContrast * look.found.range;
      ++border.against, border.drawn += drawn;
      if (bones.nearest(Vec(x + .5, y + .5)).along < kBeyondRoot) continue;
      ++border.beside, border.beside_drawn += drawn;
    }
  return border;
}

// Of points on a stretch of the bones: those that show the limb, another part, no figure.
struct Seen {
  double own = 0, other = 0, outside = 0;
};
Seen seenAlong(const PartLook& look, const LimbBones& bones, int limb, double from, double to) {
  constexpr int kSamples = 16;
  Seen seen;
  for (int i = 0; i < kSamples; ++i) {
    const Vec p = bones.at(from + (to - from) * i / (kSamples - 1));
    const cv::Point q(static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y())));
    const bool inside =
        cv::Rect(cv::Point(), look.mask.size()).contains(q) && look.mask.at<std::uint8_t>(q) != 0;
    const bool own = inside && look.part.at<std::uint8_t>(q) == static_cast<int>(limbPart(limb));
    (own ? seen.own : inside ? seen.other : seen.outside) += 1. / kSamples;
  }
  return seen;
}

double largestShare(const cv::Mat& of) {
  cv::Mat labels, stats, centres;
  const int count = cv::connectedComponentsWithStats(of, labels, stats, centres, 4);
  int largest = 0, all = 0;
  for (int i = 1; i < count; ++i) {
    const int area = stats.at<int>(i, cv::CC_STAT_AREA);
    largest = std::max(largest, area), all += area;
  }
  return all == 0 ? 1 : static_cast<double>(largest) / all;
}

double median(std::vector<double> of) {
  const auto middle = of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2);
  std::nth_element(of.begin(), middle, of.end());
  return *middle;
}

// How the limb's pixels lie about its bones.
struct Form {
  double mean_distance = 0, far = 0;  // px
  std::array<double, 4> quarters{};
  std::array<double, kStations> widths{};  // px, half of
};
// `corner`: of these planes in the picture.
Form formOf(const cv::Mat& own, const cv::Mat& depth, const cv::Point& corner, const LimbBones& bones) {
  Form form;
  std::vector<double> distances;
  for (int y = 0; y < own.rows; ++y)
    for (int x = 0; x < own.cols; ++x) {
      if (own.at<std::uint8_t>(y, x) == 0) continue;
      const auto [along, distance] = bones.nearest(Vec(corner.x + x + .5, corner.y + y + .5));
      distances.push_back(distance);
      form.quarters[static_cast<std::size_t>(std::min(3., std::floor(2 * along)))] += 1;
      const auto station =
          static_cast<std::size_t>(std::min(kStations - 1., std::floor(along / 2 * kStations)));
      form.widths[station] = std::max(form.widths[station], double(depth.at<float>(y, x)));
    }
  const auto count = static_cast<double>(distances.size());
  for (double& quarter : form.quarters) quarter /= count;
  form.mean_distance = std::accumulate(distances.begin(), distances.end(), 0.) / count;
  const auto far = distances.begin() + static_cast<std::ptrdiff_t>(.95 * (count - 1));
  std::nth_element(distances.begin(), far, distances.end());
  form.far = *far;
  return form;
}

cv::Mat depthOf(const cv::Mat& own) {
  cv::Mat wide, depth;
  cv::copyMakeBorder(own, wide, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::distanceTransform(wide, depth, cv::DIST_L2, cv::DIST_MASK_5);
  return depth(cv::Rect(cv::Point(1, 1), own.size())).clone();
}

// Of the area, what discs of that radius within it do not cover.
double raggedness(const cv::Mat& own, const cv::Mat& depth, int area, double radius) {
  cv::Mat apart;
  cv::distanceTransform(depth <= radius, apart, cv::DIST_L2, cv::DIST_MASK_5);
  return 1. - static_cast<double>(cv::countNonZero((apart <= radius) & own)) / area;
}

double share(int of, int all) { return static_cast<double>(of) / std::max(1, all); }

}  // namespace

bool liesAgainst(const LimbBorder& border) {
  return border.beside > 0 && border.beside >= kLeastBeside * border.all;
}

std::array<LimbBorder, 4> limbBorders(const PartPicture& picture, const PartSkeleton& skeleton) {
  const PartLook look(picture);
  const cv::Mat none = cv::Mat::zeros(look.mask.size(), CV_8U), arms = look.of(0) | look.of(1);
  cv::Mat edge = edgesOf(look, none);
  std::array<LimbBorder, 4> borders;
  for (int k = 0; k < 4; ++k) {
    if (k == 2) edge = edgesOf(look, arms);
    borders[static_cast<std::size_t>(k)] =
        borderOf(look, bonesOf(look, skeleton, k), look.of(k), k < 2 ? none : arms, edge);
  }
  return borders;
}

double seenOf(const PartPicture& picture, const PartSkeleton& skeleton, int limb) {
  const PartLook look(picture);
  return seenAlong(look, bonesOf(look, skeleton, limb), limb, .4, 2).own;
}

LimbEvidence limbEvidence(const PartPicture& picture, const PartSkeleton& skeleton,
                          const LimbConfidences& confidences, const LimbBorder& border, int limb) {
  const PartLook look(picture);
  const auto index = static_cast<std::size_t>(limb);
  const cv::Mat whole = look.of(limb);
  LimbEvidence evidence{cv::countNonZero(whole), {}};
  if (evidence.area == 0) return evidence;
  const cv::Rect box = cv::boundingRect(whole);
  const cv::Mat own = whole(box);
  const int figure = cv::countNonZero(look.mask), unit = std::max(look.mask.rows, look.mask.cols);
  const LimbBones bones = bonesOf(look, skeleton, limb);
  const double length = std::max(1., bones.length());
  const cv::Mat depth = depthOf(own);
  const Form form = formOf(own, depth, box.tl(), bones);
  const std::vector<double> widths(form.widths.begin(), form.widths.end());
  const double width = std::max(.5, median(widths));
  double uneven = 0;
  for (const double w : widths) uneven += (w - width) * (w - width) / kStations;
  const double thinnest = *std::min_element(widths.begin() + 2, widths.end());
  const Seen upper = seenAlong(look, bones, limb, 0, 1), lower = seenAlong(look, bones, limb, 1, 2),
             end = seenAlong(look, bones, limb, 1.5, 2);
  const auto& sure = confidences.of_limb[index];
  const std::vector<double> inputs = {
      double(limb >= 2),
      double(skeleton.animal),
      share(evidence.area, figure),
      std::log(evidence.area / (length * length) + 1e-4),
      length / unit,
      largestShare(own),
      form.mean_distance / length,
      form.far / unit,
      upper.own,
      lower.own,
      end.own,
      (upper.other + lower.other) / 2,
      (upper.outside + lower.outside) / 2,
      raggedness(own, depth, evidence.area, std::max(1., kRagged * width)),
      width / unit,
      std::sqrt(uneven) / width,
      thinnest / width,
      share(border.against, border.all),
      share(border.drawn, border.against),
      share(border.beside, border.all),
      share(border.beside_drawn, border.beside),
      form.quarters[0],
      form.quarters[1],
      form.quarters[2],
      (1 - largestShare(look.mask & ~whole)) * (1 - share(evidence.area, figure)),
      picture.sure[index],
      picture.before[index],
      sure[0],
      sure[1],
      sure[2],
      confidences.mean,
      std::log((cv::countNonZero(look.of(limb ^ 1)) + 1.) / evidence.area)};
  SKEL_CHECK_EQ(inputs.size(), kLimbInputs.size());
  evidence.inputs =
      Eigen::Map<const Eigen::VectorXd>(inputs.data(), static_cast<Eigen::Index>(inputs.size()));
  return evidence;
}

}  // namespace skel
