#include "trainer/pages/page.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "libskel/silhouette/page_net.h"
#include "trainer/pages/art.h"
#include "trainer/pages/paper.h"

namespace skel {
namespace {

constexpr double kCanvas = 2;  // long side of sheets that are drawn on, in that of the page

// A line of ground or a strip of grass under the feet.
void drawGround(Rng& rng, const Pens& pens, int y, cv::Mat& page) {
  const bool grass = rng.chance(.4);
  const cv::Scalar colour =
      grass ? cv::Scalar(rng.uniform(20, 130), rng.uniform(90, 200), rng.uniform(20, 90)) : pens.ink;
  const int width = std::max(1, static_cast<int>(std::lround(pens.line_px * rng.uniform(.7, 1.6))));
  const double slope = rng.normal(0, .02), wave = rng.uniform(0, 3);
  const int from = rng.chance(.6) ? 0 : static_cast<int>(page.cols * rng.uniform(0, .4)),
            to = rng.chance(.6) ? page.cols : static_cast<int>(page.cols * rng.uniform(.6, 1));
  cv::Point before(from, y);
  for (int x = from; x <= to; x += 8) {
    const cv::Point at(x, static_cast<int>(y + slope * (x - page.cols / 2) + wave * std::sin(x * .05)));
    cv::line(page, before, at, colour, width, cv::LINE_AA);
    if (grass && rng.chance(.7))
      cv::line(page, at,
               at + cv::Point(static_cast<int>(rng.normal(0, 4)), -static_cast<int>(rng.uniform(4, 18))),
               colour, width, cv::LINE_AA);
    before = at;
  }
  if (grass && rng.chance(.4)) page.rowRange(std::clamp(y, 0, page.rows - 1), page.rows).setTo(colour);
}

struct Drawn {
  cv::Mat rgb, figure;
};

struct Placed {
  Art art;
  int x = 0, y = 0;  // of its upper left corner, which may lie outside

  int right() const { return x + art.rgb.cols; }
  int feet() const { return y + art.rgb.rows - 4; }
};

// Somewhere between both ends, mostly in the middle.
int placed(Rng& rng, int spare) {
  return static_cast<int>(spare * (.5 + std::clamp(rng.normal(0, .22), -.5, .5)));
}

// Moves it such that the border of the page cuts it.
void overhang(Rng& rng, const cv::Size& size, Placed& figure) {
  const int over_x = static_cast<int>(figure.art.rgb.cols * rng.uniform(.02, .25)),
            over_y = static_cast<int>(figure.art.rgb.rows * rng.uniform(.02, .35));
  switch (rng.below(4)) {
    case 0:
      figure.x = -over_x;
      break;
    case 1:
      figure.x = size.width - figure.art.rgb.cols + over_x;
      break;
    case 2:
      figure.y = -over_y;
      break;
    default:
      figure.y = size.height - figure.art.rgb.rows + over_y;
  }
}

// Like a shadow that programs lay under a figure.
void dropShadow(Rng& rng, const Placed& figure, cv::Mat& page) {
  cv::Mat shade = cv::Mat::zeros(page.size(), CV_8U);
  const cv::Rect to =
      cv::Rect(figure.x, figure.y, figure.art.rgb.cols, figure.art.rgb.rows) & cv::Rect({0, 0}, page.size());
  if (to.empty()) return;
  figure.art.solid(to - cv::Point(figure.x, figure.y)).copyTo(shade(to));
  const double reach = .04 * std::max(figure.art.rgb.cols, figure.art.rgb.rows);
  const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1, 0, rng.normal(0, reach), 0, 1, rng.normal(0, reach));
  cv::warpAffine(shade, shade, shift, page.size());
  cv::GaussianBlur(shade, shade, {}, rng.uniform(.5, 8));
  const double strength = rng.uniform(.2, .7) / 255;
  for (int y = 0; y < page.rows; ++y)
    for (int x = 0; x < page.cols; ++x)
      page.at<cv::Vec3b>(y, x) *= 1 - strength * shade.at<std::uint8_t>(y, x);
}

// `tidy`: with little else around, mostly as programs and scanners give it.
Drawn drawnPage(Rng& rng, const cv::Mat& ground, const std::vector<Placed>& figures, bool tidy,
                const PageOptions& options) {
  Drawn out{ground.clone(), cv::Mat::zeros(ground.size(), CV_8U)};
  const cv::Size size = ground.size();
  const Pens pens = tidy && rng.chance(.55) ? Pens() : randomPens(rng);
  const bool same_pens = rng.chance(.7);
  const int shorter = std::min(size.width, size.height);
  const Placed& first = figures.front();
  const auto drawThings = [&](int count) {
    for (int i = 0; i < count; ++i) {
      const Art thing = thingArt(rng, static_cast<int>(shorter * rng.uniform(.08, tidy ? .25 : .5)));
      const int beside = rng.chance(.5) ? first.x - thing.rgb.cols : first.right();
      const int tx = rng.chance(.35) ? beside + static_cast<int>(rng.normal(0, .25) * thing.rgb.cols)
                                     : static_cast<int>(rng.uniform(-.3, 1) * size.width);
      const int ty = rng.chance(.5) ? first.feet() - thing.rgb.rows + static_cast<int>(rng.normal(0, 6))
                                    : static_cast<int>(rng.uniform(-.1, .9) * size.height);
      drawArt(rng, same_pens ? pens : randomPens(rng), thing, tx, ty, out.rgb);
    }
  };
  if (rng.chance(.04)) {  // a frame
    const int inset = static_cast<int>(shorter * rng.uniform(.01, .08));
    cv::rectangle(out.rgb, {inset, inset}, {size.width - inset, size.height - inset}, pens.ink,
                  1 + static_cast<int>(rng.below(4)), cv::LINE_AA);
  }
  if (rng.chance(tidy ? .15 : .3))
    drawGround(rng, pens, first.feet() + static_cast<int>(rng.normal(0, 4)), out.rgb);
  if (rng.chance(tidy ? .15 : .65)) drawThings(1 + static_cast<int>(rng.below(tidy ? 2 : 6)));
  for (const Placed& figure : figures) {
    if (rng.chance(.12))  // a shadow at the feet
      cv::ellipse(out.rgb, {figure.x + figure.art.rgb.cols / 2, figure.feet()},
                  {figure.art.rgb.cols / 2, std::max(2, figure.art.rgb.rows / 24)}, 0, 0, 360,
                  ground.at<cv::Vec3b>(0, 0) * rng.uniform(.4, .9), cv::FILLED, cv::LINE_AA);
    if (rng.chance(.05)) dropShadow(rng, figure, out.rgb);
  }
  if (rng.chance(.95)) {
    for (const Placed& figure : figures) {
      const cv::Rect to =
          cv::Rect(figure.x, figure.y, figure.art.rgb.cols, figure.art.rgb.rows) & cv::Rect({0, 0}, size);
      if (to.empty()) continue;
      const cv::Mat own = figure.art.solid(to - cv::Point(figure.x, figure.y));
      // What is behind a figure mostly stops at it.
      if (rng.chance(.85)) ground(to).copyTo(out.rgb(to), own);
      out.figure(to) |= own;
      drawArt(rng, figure.art.strokes ? strokePens(rng, pens) : pens, figure.art, figure.x, figure.y,
              out.rgb);
    }
  }
  if (!tidy && rng.chance(.2)) {  // show-through of the other side
    const Art other = figureArt(rng, options, std::max(first.art.rgb.cols, first.art.rgb.rows));
    cv::Mat behind(size, CV_8UC3, cv::Scalar::all(255));
    drawArt(rng, randomPens(rng), other, placed(rng, size.width - other.rgb.cols),
            placed(rng, size.height - other.rgb.rows), behind);
    const double faint = rng.uniform(.02, .1);
    out.rgb = out.rgb - (cv::Scalar::all(255) - behind) * faint;
  }
  return out;
}

// One or two figures on a sheet.
Drawn sheetPage(Rng& rng, const PageOptions& options) {
  const int canvas = static_cast<int>(kCanvas * kPageNetSize);
  const double aspect = rng.chance(.3) ? 1 : rng.uniform(.6, 1.6);
  const cv::Size size(static_cast<int>(canvas * std::min(1., aspect)),
                      static_cast<int>(canvas * std::min(1., 1 / aspect)));
  const int shorter = std::min(size.width, size.height);
  const bool pair = rng.chance(.08);
  std::vector<Placed> figures;
  for (int i = 0; i < (pair ? 2 : 1); ++i) {
    Placed figure{figureArt(rng, options, static_cast<int>(shorter * rng.uniform(.3, pair ? .65 : .95)))};
    figure.x = placed(rng, size.width - figure.art.rgb.cols);
    figure.y = placed(rng, size.height - figure.art.rgb.rows);
    figures.push_back(std::move(figure));
  }
  if (pair) {  // beside one another
    figures[0].x = static_cast<int>(rng.uniform(0, .1) * size.width);
    figures[1].x = std::max(figures[0].right() + 4, size.width - figures[1].art.rgb.cols -
                                                        static_cast<int>(rng.uniform(0, .1) * size.width));
  } else if (rng.chance(.08)) {
    overhang(rng, size, figures[0]);
  }
  return drawnPage(rng, paper(rng, size), figures, false, options);
}

// A figure and little else: a picture that somebody has cut out, scanned or made on a screen.
Drawn tidyPage(Rng& rng, const PageOptions& options) {
  const double long_side = kPageNetSize * rng.uniform(.6, 1.5);
  const auto margin = [&] {
    return static_cast<int>(long_side * (rng.chance(.5) ? rng.uniform(0, .06) : rng.uniform(.05, .5)));
  };
  std::vector<Placed> figures = {{figureArt(rng, options, static_cast<int>(long_side)), margin(), margin()}};
  int height = figures[0].y + figures[0].art.rgb.rows;
  if (rng.chance(.1)) {
    Placed second{figureArt(rng, options, static_cast<int>(long_side * rng.uniform(.6, 1.1)))};
    second.x = figures[0].right() + static_cast<int>(long_side * rng.uniform(.02, .2));
    second.y = std::max(0, height - second.art.rgb.rows + static_cast<int>(long_side * rng.normal(0, .03)));
    height = std::max(height, second.y + second.art.rgb.rows);
    figures.push_back(std::move(second));
  }
  const cv::Size size(figures.back().right() + margin(), height + margin());
  if (rng.chance(.12)) overhang(rng, size, figures[rng.below(static_cast<std::uint32_t>(figures.size()))]);
  return drawnPage(rng, evenGround(rng, size), figures, true, options);
}

// A window around the figure, as the second look at a page takes it.
cv::Rect windowAround(Rng& rng, const cv::Mat& figure) {
  const cv::Rect box = cv::boundingRect(figure > 127), all(0, 0, figure.cols, figure.rows);
  if (box.area() < 100) return all;
  const double side = std::max(box.width, box.height);
  const auto margin = [&] { return static_cast<int>(side * rng.uniform(.02, .5)); };
  const int l = margin(), t = margin(), r = margin(), b = margin();
  return cv::Rect(box.x - l, box.y - t, box.width + l + r, box.height + t + b) & all;
}

}  // namespace

Page generatePage(Rng& rng, const PageOptions& options) {
  const bool tidy = rng.chance(.4);
  Drawn drawn = tidy ? tidyPage(rng, options) : sheetPage(rng, options);
  if (!tidy && rng.chance(.75)) light(rng, drawn.rgb);
  if (!tidy && rng.chance(.45)) layOnTable(rng, drawn.rgb.size(), drawn.rgb, drawn.figure);
  if (rng.chance(.1))
    cv::copyMakeBorder(drawn.rgb, drawn.rgb, 6, 6, 6, 6, cv::BORDER_CONSTANT,
                       cv::Scalar::all(rng.uniform(0, 255))),
        cv::copyMakeBorder(drawn.figure, drawn.figure, 6, 6, 6, 6, cv::BORDER_CONSTANT, cv::Scalar(0));
  if (!tidy && rng.chance(.5)) {
    const cv::Rect window = windowAround(rng, drawn.figure);
    drawn = {drawn.rgb(window).clone(), drawn.figure(window).clone()};
  }
  if (rng.chance(.5)) {
    cv::flip(drawn.rgb, drawn.rgb, 1);
    cv::flip(drawn.figure, drawn.figure, 1);
  }
  // The camera.
  cv::Mat values;
  drawn.rgb.convertTo(values, CV_32FC3, 1 / 255.);
  if (rng.chance(tidy ? .2 : .5)) {
    const double gamma = std::exp(rng.normal(0, .2));
    cv::pow(values, gamma, values);
    cv::multiply(
        values,
        cv::Scalar(std::exp(rng.normal(0, .08)), std::exp(rng.normal(0, .04)), std::exp(rng.normal(0, .1))),
        values);
  }
  if (rng.chance(tidy ? .2 : .4)) cv::GaussianBlur(values, values, {}, rng.uniform(.3, 1.4));
  values.convertTo(drawn.rgb, CV_8UC3, 255);
  const double scale = static_cast<double>(kPageNetSize) / std::max(drawn.rgb.cols, drawn.rgb.rows);
  const cv::Size small(std::max(1, static_cast<int>(std::lround(drawn.rgb.cols * scale))),
                       std::max(1, static_cast<int>(std::lround(drawn.rgb.rows * scale))));
  Page page;
  const int how = scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR;
  cv::resize(drawn.rgb, page.rgb, small, 0, 0, how);
  cv::resize(drawn.figure, page.figure, small, 0, 0, how);
  return page;
}

}  // namespace skel
