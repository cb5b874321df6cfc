#include "trainer/pages/page.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "libskel/silhouette/page_net.h"
#include "trainer/pages/art.h"
#include "trainer/pages/paper.h"

namespace skel {
namespace {

constexpr int kCanvas = 384;  // long side of what is drawn on, px

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

// `tidy`: on one even colour, mostly white, with little else.
Drawn drawnPage(Rng& rng, const cv::Size& size, bool tidy, const PageOptions& options) {
  Drawn out{tidy ? cv::Mat(size, CV_8UC3, rng.chance(.6) ? cv::Scalar::all(255) : randomRgb(rng, 60, 256))
                 : paper(rng, size),
            cv::Mat::zeros(size, CV_8U)};
  const cv::Mat blank = out.rgb.clone();
  const Pens pens = randomPens(rng);
  const bool same_pens = rng.chance(.7);
  const int shorter = std::min(size.width, size.height);
  const int long_side = static_cast<int>(shorter * rng.uniform(.3, .95));
  const Art figure = figureArt(rng, options, long_side);
  const int spare_x = size.width - figure.rgb.cols, spare_y = size.height - figure.rgb.rows;
  const auto place = [&](int spare) {
    return static_cast<int>(spare * (.5 + std::clamp(rng.normal(0, .22), -.5, .5)));
  };
  const int x = place(spare_x), y = place(spare_y);
  const int feet = y + figure.rgb.rows - 4;

  const int things = rng.chance(tidy ? .25 : .65) ? 1 + static_cast<int>(rng.below(6)) : 0;
  const auto drawThings = [&](int count) {
    for (int i = 0; i < count; ++i) {
      const Art thing = thingArt(rng, static_cast<int>(shorter * rng.uniform(.08, .5)));
      const int beside = rng.chance(.5) ? x - thing.rgb.cols : x + figure.rgb.cols;
      const int tx = rng.chance(.35) ? beside + static_cast<int>(rng.normal(0, .25) * thing.rgb.cols)
                                     : static_cast<int>(rng.uniform(-.3, 1) * size.width);
      const int ty = rng.chance(.5) ? feet - thing.rgb.rows + static_cast<int>(rng.normal(0, 6))
                                    : static_cast<int>(rng.uniform(-.1, .9) * size.height);
      drawArt(rng, same_pens ? pens : randomPens(rng), thing, tx, ty, out.rgb);
    }
  };
  if (rng.chance(.3)) drawGround(rng, pens, feet + static_cast<int>(rng.normal(0, 4)), out.rgb);
  drawThings(things);
  if (rng.chance(.15)) {  // a shadow at the feet
    cv::Mat shade = out.rgb.clone();
    cv::ellipse(shade, {x + figure.rgb.cols / 2, feet},
                {figure.rgb.cols / 2, std::max(2, figure.rgb.rows / 24)}, 0, 0, 360,
                out.rgb.at<cv::Vec3b>(0, 0) * rng.uniform(.4, .8), cv::FILLED, cv::LINE_AA);
    out.rgb = shade;
  }
  if (rng.chance(.94)) {
    const cv::Rect to = cv::Rect(x, y, figure.rgb.cols, figure.rgb.rows) & cv::Rect({0, 0}, size);
    figure.solid(cv::Rect(to.x - x, to.y - y, to.width, to.height)).copyTo(out.figure(to));
    // What is behind a figure mostly stops at it.
    if (rng.chance(.85)) blank.copyTo(out.rgb, out.figure);
    drawArt(rng, figure.strokes ? strokePens(rng, pens) : pens, figure, x, y, out.rgb);
  }
  if (!tidy && rng.chance(.2)) {  // show-through of the other side
    const Art other = figureArt(rng, options, long_side);
    cv::Mat behind(size, CV_8UC3, cv::Scalar::all(255));
    drawArt(rng, randomPens(rng), other, place(spare_x), place(spare_y), behind);
    const double faint = rng.uniform(.02, .1);
    out.rgb = out.rgb - (cv::Scalar::all(255) - behind) * faint;
  }
  return out;
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
  const double aspect = rng.chance(.3) ? 1 : rng.uniform(.6, 1.6);
  const cv::Size size(static_cast<int>(kCanvas * std::min(1., aspect)),
                      static_cast<int>(kCanvas * std::min(1., 1 / aspect)));
  const bool tidy = rng.chance(.15);
  Drawn drawn = drawnPage(rng, size, tidy, options);
  if (!tidy && rng.chance(.75)) light(rng, drawn.rgb);
  if (rng.chance(.4)) layOnTable(rng, size, drawn.rgb, drawn.figure);
  if (rng.chance(.1))
    cv::copyMakeBorder(drawn.rgb, drawn.rgb, 6, 6, 6, 6, cv::BORDER_CONSTANT,
                       cv::Scalar::all(rng.uniform(0, 255))),
        cv::copyMakeBorder(drawn.figure, drawn.figure, 6, 6, 6, 6, cv::BORDER_CONSTANT, cv::Scalar(0));
  if (rng.chance(.5)) {
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
  if (rng.chance(.5)) {
    const double gamma = std::exp(rng.normal(0, .2));
    cv::pow(values, gamma, values);
    cv::multiply(
        values,
        cv::Scalar(std::exp(rng.normal(0, .08)), std::exp(rng.normal(0, .04)), std::exp(rng.normal(0, .1))),
        values);
  }
  if (rng.chance(.4)) cv::GaussianBlur(values, values, {}, rng.uniform(.3, 1.4));
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
