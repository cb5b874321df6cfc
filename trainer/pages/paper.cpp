#include "trainer/pages/paper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "trainer/pages/art.h"

namespace skel {
namespace {

void multiply(cv::Mat& page, const cv::Mat& factor) {
  for (int y = 0; y < page.rows; ++y) {
    cv::Vec3b* p = page.ptr<cv::Vec3b>(y);
    const float* f = factor.ptr<float>(y);
    for (int x = 0; x < page.cols; ++x)
      for (int k = 0; k < 3; ++k) p[x][k] = cv::saturate_cast<std::uint8_t>(p[x][k] * f[x]);
  }
}

// Adds noise of this deviation in grey levels.
void addNoise(Rng& rng, cv::Mat& page, int cell, double deviation) {
  const cv::Mat noise = smoothNoise(rng, page.size(), cell);
  multiply(page, 1 + noise * (deviation / 200));
}

// Lines in one direction every `step` px.
void rule(Rng& rng, cv::Mat& page, double step, bool upright, const cv::Scalar& colour, int width) {
  const int length = upright ? page.cols : page.rows;
  for (double at = rng.uniform(0, step); at < length; at += step) {
    const int i = static_cast<int>(at);
    cv::line(page, upright ? cv::Point(i, 0) : cv::Point(0, i),
             upright ? cv::Point(i, page.rows) : cv::Point(page.cols, i), colour, width);
  }
}

void print(Rng& rng, cv::Mat& page) {
  const double base = page.at<cv::Vec3b>(0, 0)[0], pale = base * rng.uniform(.55, .93);
  const cv::Scalar colour = rng.chance(.6) ? cv::Scalar(pale * .8, pale * .93, base * rng.uniform(.85, 1))
                                           : cv::Scalar(pale, pale, pale);
  const double step = rng.uniform(7, 22);
  const int width = rng.chance(.85) ? 1 : 2;
  const double r = rng.uniform();
  if (r < .5) {
    rule(rng, page, step, false, colour, width);
  } else if (r < .85) {
    rule(rng, page, step, false, colour, width);
    rule(rng, page, step, true, colour, width);
  } else {
    for (double y = step / 2; y < page.rows; y += step)
      for (double x = step / 2; x < page.cols; x += step)
        cv::circle(page, cv::Point(static_cast<int>(x), static_cast<int>(y)), 1, colour, cv::FILLED);
  }
  if (rng.chance(.4)) {
    const int x =
        static_cast<int>(page.cols * (rng.chance(.8) ? rng.uniform(.06, .2) : rng.uniform(.8, .94)));
    cv::line(page, {x, 0}, {x, page.rows}, cv::Scalar(base * .95, base * .6, base * .6), width);
  }
  if (rng.chance(.25)) {
    const double gap = rng.uniform(10, 60), x = page.cols * rng.uniform(.015, .05);
    for (double y = gap / 2; y < page.rows; y += gap)
      cv::circle(page, cv::Point(static_cast<int>(x), static_cast<int>(y)),
                 static_cast<int>(rng.uniform(2, 6)), randomRgb(rng, 30, 200), cv::FILLED, cv::LINE_AA);
  }
}

void screenGround(Rng& rng, cv::Mat& page) {
  const cv::Scalar a = randomRgb(rng, 30, 255), b = rng.chance(.4) ? a : randomRgb(rng, 30, 255);
  for (int y = 0; y < page.rows; ++y) {
    const double t = static_cast<double>(y) / page.rows;
    page.row(y).setTo(a * (1 - t) + b * t);
  }
  const double r = rng.uniform();
  if (r < .3) {  // land
    const int horizon = static_cast<int>(page.rows * rng.uniform(.5, .95));
    page.rowRange(horizon, page.rows).setTo(randomRgb(rng, 30, 230));
  } else if (r < .45) {
    rule(rng, page, rng.uniform(16, 60), rng.chance(.5), randomRgb(rng, 30, 255),
         static_cast<int>(rng.uniform(2, 20)));
  } else if (r < .6) {
    const cv::Scalar spot = randomRgb(rng, 30, 255);
    for (int i = 0; i < 40; ++i)
      cv::circle(
          page,
          cv::Point(static_cast<int>(rng.uniform(0, page.cols)), static_cast<int>(rng.uniform(0, page.rows))),
          static_cast<int>(rng.uniform(2, 14)), spot, cv::FILLED, cv::LINE_AA);
  }
}

}  // namespace

cv::Mat paper(Rng& rng, const cv::Size& size) {
  cv::Mat page(size, CV_8UC3);
  if (rng.chance(.12)) {
    screenGround(rng, page);
    return page;
  }
  if (rng.chance(.02)) {  // noise
    const double grey = rng.uniform(60, 200), spread = rng.uniform(20, 90);
    for (int y = 0; y < page.rows; ++y)
      for (int x = 0; x < page.cols; ++x)
        for (int k = 0; k < 3; ++k)
          page.at<cv::Vec3b>(y, x)[k] = cv::saturate_cast<std::uint8_t>(rng.normal(grey, spread));
    return page;
  }
  const double base = rng.chance(.3) ? 255 : rng.uniform(185, 255);
  page.setTo(rng.chance(.85) ? cv::Scalar(base, base * rng.uniform(.94, 1.02), base * rng.uniform(.85, 1.05))
                             : randomRgb(rng, 110, 255));
  if (rng.chance(.4)) print(rng, page);
  if (rng.chance(.6)) addNoise(rng, page, 1, rng.uniform(.5, 5));
  if (rng.chance(.4)) addNoise(rng, page, 3 + static_cast<int>(rng.below(20)), rng.uniform(.5, 5));
  return page;
}

cv::Mat evenGround(Rng& rng, const cv::Size& size) {
  cv::Mat page(size, CV_8UC3, cv::Scalar::all(255));
  const double r = rng.uniform();
  if (r < .45) return page;
  if (r < .6) {
    const double base = rng.uniform(215, 255);
    page.setTo(cv::Scalar(base, base * rng.uniform(.97, 1.01), base * rng.uniform(.92, 1.02)));
    addNoise(rng, page, 1, rng.uniform(.3, 4));
  } else if (r < .9) {
    page.setTo(rng.chance(.3) ? cv::Scalar::all(rng.uniform(0, 255)) : randomRgb(rng, 0, 256));
  } else {
    const cv::Scalar a = randomRgb(rng, 30, 255), b = randomRgb(rng, 30, 255);
    for (int y = 0; y < page.rows; ++y) {
      const double t = static_cast<double>(y) / page.rows;
      page.row(y).setTo(a * (1 - t) + b * t);
    }
  }
  return page;
}

namespace {

// An arm that reaches in from outside, often with a telephone or with fingers.
void handShadow(Rng& rng, cv::Mat& shadow) {
  const double unit = std::max(shadow.cols, shadow.rows), toward = rng.uniform(0, 2 * std::numbers::pi);
  const cv::Point2d hand(shadow.cols * rng.uniform(.2, .8), shadow.rows * rng.uniform(.2, .8)),
      along(std::cos(toward), std::sin(toward));
  const auto stroke = [&](const cv::Point2d& a, const cv::Point2d& b, double width) {
    cv::line(shadow, a, b, 1, std::max(1, static_cast<int>(width * unit)));
  };
  const double arm = rng.uniform(.06, .16);
  stroke(hand, hand - 1.5 * unit * along, arm);
  if (rng.chance(.4)) {
    const cv::RotatedRect telephone(
        hand,
        {static_cast<float>(unit * rng.uniform(.2, .4)), static_cast<float>(unit * rng.uniform(.12, .25))},
        static_cast<float>(rng.uniform(0, 180)));
    std::array<cv::Point2f, 4> corners;
    telephone.points(corners.data());
    cv::fillPoly(shadow, std::vector<cv::Point>(corners.begin(), corners.end()), 1);
  } else {
    const int fingers = 3 + static_cast<int>(rng.below(3));
    for (int i = 0; i < fingers; ++i) {
      const double a = toward + (i - (fingers - 1) / 2.) * rng.uniform(.15, .4);
      stroke(hand, hand + unit * rng.uniform(.1, .22) * cv::Point2d(std::cos(a), std::sin(a)),
             rng.uniform(.015, .04));
    }
  }
}

}  // namespace

void light(Rng& rng, cv::Mat& page) {
  const cv::Size size = page.size();
  cv::Mat factor(size, CV_32F);
  const double angle = rng.uniform(0, 2 * std::numbers::pi), slope = rng.chance(.7) ? rng.uniform(0, .5) : 0,
               vignette = rng.chance(.4) ? rng.uniform(0, .5) : 0;
  const cv::Point2d lamp(rng.uniform(0, 1), rng.uniform(0, 1));
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const double u = static_cast<double>(x) / size.width - .5,
                   v = static_cast<double>(y) / size.height - .5;
      const double r2 = std::pow(u + .5 - lamp.x, 2) + std::pow(v + .5 - lamp.y, 2);
      factor.at<float>(y, x) = static_cast<float>(1 + slope * (u * std::cos(angle) + v * std::sin(angle)) -
                                                  vignette * r2 - slope / 3);
    }
  if (rng.chance(.3))
    factor += smoothNoise(rng, size, 40 + static_cast<int>(rng.below(80))) * rng.uniform(0, .07);
  if (rng.chance(.25)) {  // folds
    const int folds = 1 + static_cast<int>(rng.below(3));
    for (int i = 0; i < folds; ++i) {
      const double a = rng.chance(.7) ? (rng.chance(.5) ? 0 : std::numbers::pi / 2) + rng.normal(0, .05)
                                      : rng.uniform(0, std::numbers::pi);
      const double at = rng.uniform(.2, .8), step = rng.uniform(-.12, .12), crease = rng.uniform(-.25, .2);
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
          const double d = (x - at * size.width) * std::cos(a) + (y - at * size.height) * std::sin(a);
          factor.at<float>(y, x) +=
              static_cast<float>((d > 0 ? step * std::exp(-d / 60) : 0) + (std::abs(d) < 1.2 ? crease : 0));
        }
    }
  }
  if (rng.chance(.3)) {  // the shadow of a hand, or of who takes the picture
    cv::Mat shadow = cv::Mat::zeros(size, CV_32F);
    if (rng.chance(.6)) {
      handShadow(rng, shadow);
    } else {
      std::vector<cv::Point> corners;
      const double cx = size.width * rng.uniform(-.1, 1.1), cy = size.height * rng.uniform(.2, 1.2);
      for (int i = 0; i < 9; ++i) {
        const double a = 2 * std::numbers::pi * i / 9, r = size.width * rng.uniform(.1, .45);
        corners.emplace_back(static_cast<int>(cx + r * std::cos(a)), static_cast<int>(cy + r * std::sin(a)));
      }
      cv::fillPoly(shadow, corners, 1);
    }
    const double soft = rng.uniform(1, 18);
    cv::GaussianBlur(shadow, shadow, {}, soft);
    factor = factor.mul(1 - shadow * rng.uniform(.12, .5));
  }
  multiply(page, cv::max(factor, .15));
}

cv::Mat table(Rng& rng, const cv::Size& size) {
  cv::Mat out(size, CV_8UC3, randomRgb(rng, 20, 240));
  const double r = rng.uniform();
  if (r < .35) {  // wood
    out.setTo(cv::Scalar(rng.uniform(70, 220), rng.uniform(50, 170), rng.uniform(20, 120)));
    cv::Mat grain = smoothNoise(rng, {size.width, size.height / 12 + 2}, 24), streaks;
    cv::resize(grain, streaks, {size.width, size.height}, 0, 0, cv::INTER_LINEAR);
    cv::Mat fine = smoothNoise(rng, {size.width / 16 + 2, size.height}, 2), lines;
    cv::resize(fine, lines, size, 0, 0, cv::INTER_LINEAR);
    multiply(out, cv::max(1 + streaks * .08 + lines * rng.uniform(.02, .12), .2));
    if (rng.chance(.4)) rule(rng, out, rng.uniform(40, 130), false, randomRgb(rng, 20, 80), 2);
    if (rng.chance(.5)) cv::rotate(out, out, cv::ROTATE_90_CLOCKWISE), cv::resize(out, out, size);
  } else if (r < .65) {  // cloth
    const cv::Scalar other = randomRgb(rng, 20, 255);
    const int cell = 8 + static_cast<int>(rng.below(40));
    const bool gingham = rng.chance(.5);
    cv::Mat ground = out.clone();
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        const bool a = (x / cell) % 2 != 0, b = (y / cell) % 2 != 0;
        const double t = gingham ? .5 * (a + b) : a != b;
        cv::Vec3b& p = out.at<cv::Vec3b>(y, x);
        for (int k = 0; k < 3; ++k) p[k] = cv::saturate_cast<std::uint8_t>((1 - t) * p[k] + t * other[k]);
      }
  } else if (r < .8) {
    addNoise(rng, out, 2 + static_cast<int>(rng.below(6)), rng.uniform(5, 40));
  }
  addNoise(rng, out, 1, rng.uniform(0, 6));
  const int things = rng.chance(.4) ? 1 + static_cast<int>(rng.below(4)) : 0;
  for (int i = 0; i < things; ++i) {
    const cv::Point2f at(static_cast<float>(rng.uniform(0, size.width)),
                         static_cast<float>(rng.uniform(0, size.height)));
    const cv::RotatedRect pencil(
        at, {static_cast<float>(rng.uniform(40, 160)), static_cast<float>(rng.uniform(4, 14))},
        static_cast<float>(rng.uniform(0, 180)));
    std::array<cv::Point2f, 4> corners;
    pencil.points(corners.data());
    std::vector<cv::Point> polygon(corners.begin(), corners.end());
    cv::fillPoly(out, polygon, randomRgb(rng, 10, 250), cv::LINE_AA);
  }
  return out;
}

void layOnTable(Rng& rng, const cv::Size& size, cv::Mat& page, cv::Mat& mask) {
  cv::Mat under = table(rng, size);
  const double spread = rng.uniform(.0, .14), turn = rng.normal(0, rng.chance(.8) ? .06 : .3);
  const double scale = rng.uniform(.62, .97) * std::min(static_cast<double>(size.width) / page.cols,
                                                        static_cast<double>(size.height) / page.rows);
  const cv::Point2d middle(size.width * (.5 + rng.normal(0, .03)), size.height * (.5 + rng.normal(0, .03)));
  std::array<cv::Point2f, 4> from = {cv::Point2f(0, 0),
                                     {static_cast<float>(page.cols), 0},
                                     {static_cast<float>(page.cols), static_cast<float>(page.rows)},
                                     {0, static_cast<float>(page.rows)}};
  std::array<cv::Point2f, 4> to;
  for (std::size_t i = 0; i < 4; ++i) {
    const double x = (from[i].x - page.cols / 2.) * scale * (1 - rng.uniform(0, spread)),
                 y = (from[i].y - page.rows / 2.) * scale * (1 - rng.uniform(0, spread));
    to[i] = {static_cast<float>(middle.x + x * std::cos(turn) - y * std::sin(turn)),
             static_cast<float>(middle.y + x * std::sin(turn) + y * std::cos(turn))};
  }
  const cv::Mat perspective = cv::getPerspectiveTransform(from, to);
  cv::Mat sheet(page.size(), CV_8U, cv::Scalar(255)), where, picture, figure;
  cv::warpPerspective(sheet, where, perspective, size, cv::INTER_LINEAR);
  cv::warpPerspective(page, picture, perspective, size, cv::INTER_LINEAR);
  cv::warpPerspective(mask, figure, perspective, size, cv::INTER_LINEAR);
  if (rng.chance(.6)) {  // the sheet's own shadow
    cv::Mat shadow, moved;
    where.convertTo(shadow, CV_32F, 1 / 255.);
    const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1, 0, rng.normal(0, 4), 0, 1, rng.normal(0, 4));
    cv::warpAffine(shadow, moved, shift, size);
    cv::GaussianBlur(moved, moved, {}, rng.uniform(1, 5));
    multiply(under, 1 - moved * rng.uniform(.1, .6));
  }
  picture.copyTo(under, where > 127);
  if (rng.chance(.12)) {  // a finger that holds the sheet
    const bool left = rng.chance(.5);
    const cv::Point at(left ? static_cast<int>(size.width * .05) : static_cast<int>(size.width * .95),
                       static_cast<int>(size.height * rng.uniform(.2, .95)));
    const double skin = rng.uniform(.4, 1);
    cv::ellipse(under, at, {static_cast<int>(rng.uniform(20, 60)), static_cast<int>(rng.uniform(8, 18))},
                rng.uniform(-30, 30), 0, 360, cv::Scalar(235 * skin, 180 * skin, 150 * skin), cv::FILLED,
                cv::LINE_AA);
  }
  page = under;
  mask = figure;
}

}  // namespace skel
