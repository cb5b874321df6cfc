#include "trainer/pages/hard_pages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace skel {
namespace {

double real(Rng& rng, double low, double high) { return rng.uniform(low, high); }

// `multiplied`: as ink on paper, else as paint.
void put(const PageArt& art, const cv::Point& at, bool multiplied, cv::Mat& page) {
  const cv::Rect to = cv::Rect(at.x, at.y, art.rgb.cols, art.rgb.rows) & cv::Rect({0, 0}, page.size());
  for (int y = to.y; y < to.y + to.height; ++y)
    for (int x = to.x; x < to.x + to.width; ++x) {
      const float a = art.cover.at<float>(y - at.y, x - at.x);
      const cv::Vec3b& c = art.rgb.at<cv::Vec3b>(y - at.y, x - at.x);
      cv::Vec3b& p = page.at<cv::Vec3b>(y, x);
      for (int k = 0; k < 3; ++k)
        p[k] = cv::saturate_cast<std::uint8_t>(p[k] + a * ((multiplied ? p[k] * c[k] / 255.f : c[k]) - p[k]));
    }
}

// The drawing's lines alone: where its colours change.
PageArt lines(const PageArt& art, int width, double grey) {
  cv::Mat edges = cv::Mat::zeros(art.mask.size(), CV_8U);
  cv::Mat flat = art.rgb.clone();
  flat.setTo(cv::Scalar::all(255), art.mask == 0);
  cv::medianBlur(flat, flat, 5);
  std::vector<cv::Mat> channels;
  cv::split(flat, channels);
  channels.push_back(art.mask);
  for (const cv::Mat& channel : channels) {
    cv::Mat steep;
    cv::morphologyEx(channel, steep, cv::MORPH_GRADIENT, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}));
    edges |= steep > 60;
  }
  edges &= art.mask;
  if (width > 2)
    cv::dilate(edges, edges, cv::getStructuringElement(cv::MORPH_ELLIPSE, {width - 1, width - 1}));
  PageArt out{cv::Mat(art.rgb.size(), CV_8UC3, cv::Scalar::all(grey)), {}, art.mask | edges};
  edges.convertTo(out.cover, CV_32F, 1 / 255.);
  cv::GaussianBlur(out.cover, out.cover, {3, 3}, .6);
  return out;
}

cv::Mat noise(Rng& rng, const cv::Size& size, int cell) {
  cv::Mat coarse(size.height / cell + 2, size.width / cell + 2, CV_32F), out;
  for (int y = 0; y < coarse.rows; ++y)
    for (int x = 0; x < coarse.cols; ++x) coarse.at<float>(y, x) = static_cast<float>(rng.normal());
  cv::resize(coarse, out, {coarse.cols * cell, coarse.rows * cell}, 0, 0, cv::INTER_CUBIC);
  return out(cv::Rect({0, 0}, size)).clone();
}

void multiply(cv::Mat& page, const cv::Mat& factor) {
  for (int y = 0; y < page.rows; ++y)
    for (int x = 0; x < page.cols; ++x)
      for (int k = 0; k < 3; ++k) {
        std::uint8_t& p = page.at<cv::Vec3b>(y, x)[k];
        p = cv::saturate_cast<std::uint8_t>(p * factor.at<float>(y, x));
      }
}

cv::Mat paper(Rng& rng, const cv::Size& size) {
  const double base = real(rng, 205, 252);
  cv::Mat page(size, CV_8UC3, cv::Scalar(base, base * real(rng, .97, 1), base * real(rng, .9, 1)));
  multiply(page, 1 + noise(rng, size, 1) * .008 + noise(rng, size, 7) * .006);
  return page;
}

cv::Scalar colour(Rng& rng) { return {real(rng, 0, 255), real(rng, 0, 255), real(rng, 0, 255)}; }

void unevenLight(Rng& rng, cv::Mat& page, bool shadow) {
  cv::Mat factor(page.size(), CV_32F);
  const double a = real(rng, 0, 6.28), slope = real(rng, .1, .45);
  for (int y = 0; y < page.rows; ++y)
    for (int x = 0; x < page.cols; ++x)
      factor.at<float>(y, x) =
          static_cast<float>(1 - slope * (.5 + .35 * ((2. * x / page.cols - 1) * std::cos(a) +
                                                      (2. * y / page.rows - 1) * std::sin(a))));
  if (shadow) {
    cv::Mat dark = cv::Mat::zeros(page.size(), CV_32F);
    const cv::Point centre(static_cast<int>(page.cols * real(rng, .1, .9)),
                           static_cast<int>(page.rows * real(rng, .3, 1)));
    cv::ellipse(
        dark, centre,
        {static_cast<int>(page.cols * real(rng, .12, .35)), static_cast<int>(page.rows * real(rng, .2, .6))},
        real(rng, 0, 180), 0, 360, real(rng, .2, .5), cv::FILLED);
    cv::line(dark, centre, {centre.x + static_cast<int>(real(rng, -.5, .5) * page.cols), page.rows},
             real(rng, .2, .5), page.cols / 8);
    cv::GaussianBlur(dark, dark, {}, page.cols * real(rng, .004, .03));
    factor = factor.mul(1 - dark);
  }
  multiply(page, factor);
}

void rule(Rng& rng, cv::Mat& page) {
  const double step = page.rows * real(rng, .025, .05);
  const cv::Scalar ink(real(rng, 120, 190), real(rng, 150, 205), real(rng, 190, 235));
  const int width = std::max(1, page.cols / 700);
  for (double y = step; y < page.rows; y += step)
    cv::line(page, cv::Point2d(0, y), cv::Point2d(page.cols, y), ink, width);
  if (rng.chance(.5))
    for (double x = step; x < page.cols; x += step)
      cv::line(page, cv::Point2d(x, 0), cv::Point2d(x, page.rows), ink, width);
  else
    cv::line(page, cv::Point2d(page.cols * .12, 0), cv::Point2d(page.cols * .12, page.rows), {220, 140, 150},
             width);
}

cv::Mat canvasFor(const PageArt& art, double margin) {
  return cv::Mat(art.rgb.rows + 2 * static_cast<int>(margin * art.rgb.rows),
                 art.rgb.cols + 2 * static_cast<int>(margin * art.rgb.rows), CV_8UC3, cv::Scalar::all(255));
}

HardPage laid(const PageArt& art, cv::Mat page, const cv::Point& at, bool multiplied) {
  put(art, at, multiplied, page);
  cv::Mat drawn(page.size(), CV_8UC3, cv::Scalar::all(255)), mask = cv::Mat::zeros(page.size(), CV_8U);
  put(art, at, false, drawn);
  const cv::Rect to = cv::Rect(at.x, at.y, art.mask.cols, art.mask.rows) & cv::Rect({0, 0}, page.size());
  art.mask(to - at).copyTo(mask(to));
  return {page, {mask}, drawn};
}
cv::Point middle(const PageArt& art, const cv::Mat& page) {
  return {(page.cols - art.rgb.cols) / 2, (page.rows - art.rgb.rows) / 2};
}
HardPage laid(const PageArt& art, const cv::Mat& page, bool multiplied) {
  return laid(art, page, middle(art, page), multiplied);
}

void scenery(Rng& rng, const PageArt& art, cv::Mat& page) {
  const cv::Point at = middle(art, page);
  const int ground = at.y + art.rgb.rows * 11 / 12, unit = page.rows;
  const cv::Scalar ink = rng.chance(.5) ? cv::Scalar::all(60) : colour(rng);
  const int width = std::max(2, unit / 250);
  cv::line(page, {0, ground}, {page.cols, ground + static_cast<int>(unit * rng.normal(0, .01))}, ink, width,
           cv::LINE_AA);
  const int left = page.cols / 25, side = page.cols / 6;
  cv::rectangle(page, {left, ground - side}, {left + side, ground}, rng.chance(.5) ? ink : colour(rng), width,
                cv::LINE_AA);
  cv::line(page, {left, ground - side}, {left + side / 2, ground - 3 * side / 2}, ink, width, cv::LINE_AA);
  cv::line(page, {left + side / 2, ground - 3 * side / 2}, {left + side, ground - side}, ink, width,
           cv::LINE_AA);
  cv::circle(page, {page.cols - side / 2, side / 2}, side / 3, {250, 200, 40}, rng.chance(.5) ? width : -1,
             cv::LINE_AA);
  const int trunk = page.cols - side / 2;
  cv::line(page, {trunk, ground}, {trunk, ground - side}, {120, 80, 40}, 4 * width, cv::LINE_AA);
  cv::circle(page, {trunk, ground - 5 * side / 4}, side * 2 / 5, {60, 150, 60}, rng.chance(.5) ? width : -1,
             cv::LINE_AA);
}

void ontoTable(Rng& rng, HardPage& sheet) {
  const cv::Size size(sheet.rgb.cols * 5 / 4, sheet.rgb.rows * 5 / 4);
  cv::Mat table(size, CV_8UC3, cv::Scalar(real(rng, 60, 200), real(rng, 40, 160), real(rng, 20, 130)));
  cv::Mat streaks;
  cv::resize(noise(rng, {size.width / 40 + 2, size.height}, 3), streaks, size, 0, 0, cv::INTER_CUBIC);
  multiply(table, 1 + streaks * .12);
  std::array<cv::Point2f, 4> from, to;
  for (std::size_t i = 0; i < 4; ++i) {
    const double x = i == 1 || i == 2, y = i >= 2;
    from[i] = {static_cast<float>(x * sheet.rgb.cols), static_cast<float>(y * sheet.rgb.rows)};
    to[i] = {static_cast<float>(size.width * (.08 + .84 * x + rng.normal(0, .025))),
             static_cast<float>(size.height * (.08 + .84 * y + rng.normal(0, .025)))};
  }
  const cv::Mat perspective = cv::getPerspectiveTransform(from, to);
  cv::Mat where, picture, figure, drawn;
  cv::warpPerspective(cv::Mat(sheet.rgb.size(), CV_8U, 255), where, perspective, size);
  cv::warpPerspective(sheet.rgb, picture, perspective, size, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::warpPerspective(sheet.figures[0], figure, perspective, size);
  cv::warpPerspective(sheet.drawn, drawn, perspective, size, cv::INTER_LINEAR, cv::BORDER_CONSTANT,
                      cv::Scalar::all(255));
  picture.copyTo(table, where > 127);
  sheet = {table, {figure > 127}, drawn};
  unevenLight(rng, sheet.rgb, false);
}

}  // namespace

PageArt pageArt(const Image& image, const Plane8& mask) {
  PageArt art{cv::Mat(image.height, image.width, CV_8UC3), cv::Mat(image.height, image.width, CV_32F),
              cv::Mat(image.height, image.width, CV_8U)};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.pixel(x, y);
      art.mask.at<std::uint8_t>(y, x) = mask(y, x) >= 128 ? 255 : 0;
      for (int c = 0; c < 3; ++c)
        art.rgb.at<cv::Vec3b>(y, x)[c] = static_cast<std::uint8_t>(255 - (255 - p[c]) * p[3] / 255);
    }
  art.mask.convertTo(art.cover, CV_32F, 1 / 255.);
  cv::GaussianBlur(art.cover, art.cover, {3, 3}, .5);
  const cv::Rect box = cv::boundingRect(art.mask);
  const int margin = std::max(box.width, box.height) / 12;
  const auto wide = [&](const cv::Mat& of, const cv::Scalar& ground) {
    cv::Mat out;
    cv::copyMakeBorder(of(box), out, margin, margin, margin, margin, cv::BORDER_CONSTANT, ground);
    return out;
  };
  return {wide(art.rgb, cv::Scalar::all(255)), wide(art.cover, 0), wide(art.mask, 0)};
}

std::vector<Circumstance> circumstances() {
  return {
      {"white",
       [](Rng&, const PageArt& art, const PageArt&) { return laid(art, canvasFor(art, .0), false); }},
      {"colour",
       [](Rng& rng, const PageArt& art, const PageArt&) {
         cv::Mat page = canvasFor(art, .05);
         page.setTo(colour(rng));
         return laid(art, page, false);
       }},
      {"pencil",
       [](Rng& rng, const PageArt& art, const PageArt&) {
         const PageArt drawn = lines(art, 2, real(rng, 110, 175));
         return laid(drawn, paper(rng, canvasFor(art, .2).size()), false);
       }},
      {"gaps",
       [](Rng& rng, const PageArt& art, const PageArt&) {
         PageArt drawn = lines(art, 4, real(rng, 10, 80));
         drawn.cover.setTo(0, noise(rng, drawn.cover.size(), 12) > 1.4);
         return laid(drawn, rng.chance(.5) ? canvasFor(art, .1) : paper(rng, canvasFor(art, .1).size()),
                     false);
       }},
      {"pieces",
       [](Rng& rng, const PageArt& art, const PageArt&) {
         HardPage sheet = laid(art, canvasFor(art, .05), false);
         for (int i = 0; i < 3; ++i) {
           const int y = static_cast<int>(sheet.rgb.rows * real(rng, .2, .8)),
                     x = static_cast<int>(sheet.rgb.cols * real(rng, .2, .8)),
                     width = std::max(2, sheet.rgb.rows / 90);
           const cv::Point a = i < 2 ? cv::Point(0, y) : cv::Point(x, 0),
                           b = i < 2 ? cv::Point(sheet.rgb.cols, y) : cv::Point(x, sheet.rgb.rows);
           for (cv::Mat picture : {sheet.rgb, sheet.drawn})
             cv::line(picture, a, b, cv::Scalar::all(255), width);
         }
         return sheet;
       }},
      {"border",
       [](Rng& rng, const PageArt& art, const PageArt&) {
         cv::Mat page = canvasFor(art, .1);
         if (rng.chance(.5)) page.setTo(colour(rng));
         HardPage sheet = laid(art, page, false);
         const cv::Rect box = cv::boundingRect(sheet.figures[0]);
         cv::Rect kept({0, 0}, page.size());
         const int cut_x = static_cast<int>(box.width * real(rng, .05, .2)),
                   cut_y = static_cast<int>(box.height * real(rng, .05, .25));
         const std::uint32_t side = rng.below(3);
         if (side == 0) kept.height = box.y + box.height - cut_y;
         if (side == 1) kept.width = box.x + box.width - cut_x;
         if (side == 2) kept.x = box.x + cut_x, kept.width -= kept.x;
         return HardPage{
             sheet.rgb(kept).clone(), {sheet.figures[0](kept).clone()}, sheet.drawn(kept).clone()};
       }},
      {"shadow",
       [](Rng& rng, const PageArt& art, const PageArt&) {
         HardPage sheet = laid(rng.chance(.5) ? lines(art, 3, real(rng, 20, 90)) : art,
                               paper(rng, canvasFor(art, .2).size()), true);
         unevenLight(rng, sheet.rgb, true);
         return sheet;
       }},
      {"ruled",
       [](Rng& rng, const PageArt& art, const PageArt&) {
         cv::Mat page = paper(rng, canvasFor(art, .2).size());
         rule(rng, page);
         HardPage sheet = laid(rng.chance(.6) ? lines(art, 3, real(rng, 20, 90)) : art, page, true);
         if (rng.chance(.5)) unevenLight(rng, sheet.rgb, false);
         return sheet;
       }},
      {"scenery",
       [](Rng& rng, const PageArt& art, const PageArt&) {
         cv::Mat page = rng.chance(.5) ? canvasFor(art, .25) : paper(rng, canvasFor(art, .25).size());
         scenery(rng, art, page);
         return laid(rng.chance(.5) ? lines(art, 4, real(rng, 10, 80)) : art, page, false);
       }},
      {"two",
       [](Rng& rng, const PageArt& art, const PageArt& other) {
         PageArt second = other;
         const double scale = .9 * art.rgb.rows / other.rgb.rows;
         cv::resize(other.rgb, second.rgb, {}, scale, scale, cv::INTER_AREA);
         cv::resize(other.cover, second.cover, {}, scale, scale, cv::INTER_AREA);
         cv::resize(other.mask, second.mask, {}, scale, scale, cv::INTER_NEAREST);
         cv::Mat page(art.rgb.rows * 11 / 10, art.rgb.cols + second.rgb.cols, CV_8UC3, cv::Scalar::all(255));
         if (rng.chance(.3)) page.setTo(colour(rng));
         const cv::Point at(0, page.rows - art.rgb.rows), beside(art.rgb.cols, page.rows - second.rgb.rows);
         HardPage sheet = laid(art, page, at, false);
         const HardPage both = laid(second, sheet.rgb, beside, false);
         put(second, beside, false, sheet.drawn);
         return HardPage{both.rgb, {sheet.figures[0], both.figures[0]}, sheet.drawn};
       }},
      {"table",
       [](Rng& rng, const PageArt& art, const PageArt&) {
         HardPage sheet = laid(rng.chance(.5) ? lines(art, 3, real(rng, 20, 110)) : art,
                               paper(rng, canvasFor(art, .2).size()), true);
         ontoTable(rng, sheet);
         return sheet;
       }},
  };
}

double overlapOnPage(const HardPage& page, const Plane8& mask) {
  const cv::Mat found(static_cast<int>(mask.rows()), static_cast<int>(mask.cols()), CV_8U,
                      const_cast<std::uint8_t*>(mask.data()));
  double best = 0;
  for (const cv::Mat& figure : page.figures)
    best = std::max(best, static_cast<double>(cv::countNonZero(found & figure)) /
                              std::max(1, cv::countNonZero(found | figure)));
  return best;
}

}  // namespace skel
