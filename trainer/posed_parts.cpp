#include "trainer/posed_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace skel {
namespace {

using Vec = Eigen::Vector2d;
using Plane = cv::Mat_<std::uint8_t>;

Vec turned(const Vec& p, const Vec& centre, double angle) {
  return centre + Eigen::Rotation2Dd(angle) * (p - centre);
}

// Of each pixel the limb that it moves with, or -1: its own part, or a thing held at its end.
cv::Mat_<int> carriers(const PartSample& sample, double reach) {
  cv::Mat_<int> carrier(sample.part.size(), -1);
  for (int y = 0; y < carrier.rows; ++y)
    for (int x = 0; x < carrier.cols; ++x) {
      const int limb = int(sample.part.at<std::uint8_t>(y, x)) - int(Part::kRightArm);
      if (limb >= 0 && limb < 4) carrier(y, x) = limb;
    }
  cv::Mat_<int> things;
  const int count = cv::connectedComponents(sample.part == int(Part::kThing), things, 8, CV_32S);
  struct End {
    double distance = std::numeric_limits<double>::infinity();
    int limb = -1;
  };
  std::vector<End> ends(static_cast<std::size_t>(count));
  for (int y = 0; y < carrier.rows; ++y)
    for (int x = 0; x < carrier.cols; ++x)
      if (const int thing = things(y, x); thing > 0)
        for (int k = 0; k < 4; ++k) {
          const double d = (sample.skeleton.limbs[std::size_t(k)][2] - Vec(x + .5, y + .5)).norm();
          if (End& end = ends[std::size_t(thing)]; d < end.distance) end = {d, k};
        }
  for (int y = 0; y < carrier.rows; ++y)
    for (int x = 0; x < carrier.cols; ++x)
      if (const int thing = things(y, x); thing > 0 && ends[std::size_t(thing)].distance < reach)
        carrier(y, x) = ends[std::size_t(thing)].limb;
  return carrier;
}

// Closes the gaps that limbs leave which lay before the rest.
void fillBehind(const cv::Mat_<int>& carrier, const std::array<int, 4>& before, int reach, PartSample& body) {
  Plane hole(body.mask.size(), std::uint8_t(0));
  for (int y = 0; y < hole.rows; ++y)
    for (int x = 0; x < hole.cols; ++x)
      if (const int limb = carrier(y, x); limb >= 0 && before[std::size_t(limb)] == 1) hole(y, x) = 255;
  cv::Mat closed;
  cv::morphologyEx(body.mask, closed, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * reach + 1, 2 * reach + 1)));
  hole &= closed;
  // Nearest pixel of the body, and nearest of its rim: where the gap meets the outside, an outline goes on.
  const auto nearest = [](const cv::Mat& of) {
    cv::Mat distance, label;
    cv::distanceTransform(of == 0, distance, label, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
    std::vector<cv::Point> at(1);
    for (int y = 0; y < of.rows; ++y)
      for (int x = 0; x < of.cols; ++x)
        if (of.at<std::uint8_t>(y, x) != 0) {
          const auto i = static_cast<std::size_t>(label.at<int>(y, x));
          if (at.size() <= i) at.resize(i + 1);
          at[i] = {x, y};
        }
    return std::pair(label, at);
  };
  if (cv::countNonZero(body.mask) == 0 || cv::countNonZero(hole) == 0) return;
  cv::Mat inner, whole = body.mask | hole, from_outside;
  cv::erode(whole, inner, cv::Mat::ones(3, 3, CV_8U));
  const cv::Mat rim = body.mask & ~inner;
  if (cv::countNonZero(rim) == 0) return;
  cv::distanceTransform(whole, from_outside, cv::DIST_L2, cv::DIST_MASK_3);
  const auto [body_label, body_at] = nearest(body.mask);
  const auto [rim_label, rim_at] = nearest(rim);
  constexpr float kRim = 1.5F;  // px
  for (int y = 0; y < hole.rows; ++y)
    for (int x = 0; x < hole.cols; ++x) {
      if (hole(y, x) == 0) continue;
      const cv::Point p = body_at[static_cast<std::size_t>(body_label.at<int>(y, x))],
                      q = rim_at[static_cast<std::size_t>(rim_label.at<int>(y, x))];
      body.rgb.at<cv::Vec3b>(y, x) = body.rgb.at<cv::Vec3b>(from_outside.at<float>(y, x) < kRim ? q : p);
      body.part.at<std::uint8_t>(y, x) = body.part.at<std::uint8_t>(p);
      body.order.at<std::uint16_t>(y, x) = body.order.at<std::uint16_t>(p);
      body.mask.at<std::uint8_t>(y, x) = 255;
    }
}

}  // namespace

PartSample posedPartSample(Rng& rng, const PartSample& sample) {
  const int side = std::max(sample.mask.rows, sample.mask.cols);
  const PartSample from = withMargin(sample, side / 2);
  const std::array<int, 4> before = limbsBefore(from);
  const cv::Mat_<int> carrier = carriers(from, .06 * side);

  PartSample out = from;
  for (cv::Mat* plane : {&out.rgb, &out.mask, &out.part, &out.order}) *plane = plane->clone();
  for (int y = 0; y < carrier.rows; ++y)
    for (int x = 0; x < carrier.cols; ++x)
      if (carrier(y, x) >= 0) {
        out.rgb.at<cv::Vec3b>(y, x) = cv::Vec3b::all(255);
        out.mask.at<std::uint8_t>(y, x) = 0;
        out.part.at<std::uint8_t>(y, x) = kNoPart;
        out.order.at<std::uint16_t>(y, x) = 0;
      }
  // Ranks: limbs behind the body from 1, the body's own from kBody, limbs before it above all.
  constexpr int kBody = 8, kFront = 60000;
  const cv::Mat on = out.mask != 0;
  cv::add(out.order, cv::Scalar(kBody), out.order, on);
  fillBehind(carrier, before, side / 10, out);

  for (const int k : {2, 3, 0, 1}) {  // arms before legs
    const auto limb = static_cast<std::size_t>(k);
    const bool arm = k < 2 && !from.skeleton.animal;
    auto& bones = out.skeleton.limbs[limb];
    const Vec root = bones[0], middle = bones[1], end = bones[2];
    const bool still = rng.chance(.25);
    const double wide = arm ? (rng.chance(.3) ? 1.4 : .5) : .25;
    const double swing = still ? 0 : rng.normal(0, wide), bend = still ? 0 : rng.normal(0, arm ? .7 : .25);
    const Vec upper = (middle - root).normalized(), lower = (end - middle).normalized();
    const Vec along = (upper + lower).norm() > 1e-3 ? Vec((upper + lower).normalized()) : upper;
    const double soft = std::max(2., .2 * (end - middle).norm());
    const auto pose = [&](const Vec& p) {
      const double share = std::clamp((p - middle).dot(along) / (2 * soft) + .5, 0., 1.);
      return turned(turned(p, middle, share * bend), root, swing);
    };
    const bool front = before[limb] < 0 ? rng.chance(arm ? .7 : .5) : (before[limb] == 1) != rng.chance(.15);
    constexpr int kSamples = 3;  // a px and direction, so that bends leave no gaps
    for (int y = 0; y < carrier.rows; ++y)
      for (int x = 0; x < carrier.cols; ++x) {
        if (carrier(y, x) != k) continue;
        for (int i = 0; i < kSamples * kSamples; ++i) {
          const Vec p =
              pose(Vec(x + (i % kSamples + .5) / kSamples, y + (double(i / kSamples) + .5) / kSamples));
          const int u = static_cast<int>(std::floor(p.x())), v = static_cast<int>(std::floor(p.y()));
          if (u < 0 || v < 0 || u >= carrier.cols || v >= carrier.rows) continue;
          auto& rank = out.order.at<std::uint16_t>(v, u);
          const int mine = front ? kFront + k : 1 + k;
          if (rank > mine) continue;
          rank = static_cast<std::uint16_t>(mine);
          out.mask.at<std::uint8_t>(v, u) = 255;
          out.rgb.at<cv::Vec3b>(v, u) = from.rgb.at<cv::Vec3b>(y, x);
          out.part.at<std::uint8_t>(v, u) = from.part.at<std::uint8_t>(y, x);
        }
      }
    for (Vec& joint : bones) joint = pose(joint);
  }
  return smallPartSample(out);
}

}  // namespace skel
