#include "trainer/pages/art.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>
#include <string_view>

#include "trainer/figures/biped_plan.h"
#include "trainer/figures/drawing.h"
#include "trainer/figures/warped_drawing.h"

namespace skel {
namespace {

constexpr double kPi = std::numbers::pi;

Art artOf(int width, int height, const std::vector<std::uint8_t>& solid, const std::vector<Colour>& colours) {
  Art art{cv::Mat(height, width, CV_8UC3), cv::Mat(height, width, CV_8U)};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      art.solid.at<std::uint8_t>(y, x) = solid[i] != 0 ? 255 : 0;
      art.rgb.at<cv::Vec3b>(y, x) = {colours[i][0], colours[i][1], colours[i][2]};
    }
  return art;
}

Art artOf(const Scene& scene, int long_side) {
  const Scene::Box box = scene.box();
  const Eigen::Vector2d size = box.high - box.low;
  const double scale = long_side / size.maxCoeff();
  constexpr int kMargin = 4;
  const int width = static_cast<int>(std::ceil(size.x() * scale)) + 2 * kMargin,
            height = static_cast<int>(std::ceil(size.y() * scale)) + 2 * kMargin;
  const Raster raster =
      rasterize(scene, box.low - Eigen::Vector2d::Constant(kMargin / scale), scale, width, height);
  std::vector<std::uint8_t> solid(raster.part.size());
  std::vector<Colour> colours(raster.part.size(), {255, 255, 255});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      solid[i] = raster.solid(x, y);
      if (solid[i]) colours[i] = raster.colour(x, y);
    }
  return artOf(width, height, solid, colours);
}

// A canvas of unit size on which things are painted.
class Easel {
 public:
  explicit Easel(int size) : size_(size) {
    art_.rgb = cv::Mat(size, size, CV_8UC3, cv::Scalar::all(255));
    art_.solid = cv::Mat::zeros(size, size, CV_8U);
  }
  void polygon(std::initializer_list<cv::Point2d> corners, const cv::Scalar& colour) {
    std::vector<cv::Point> points;
    for (const cv::Point2d& c : corners) points.push_back(at(c));
    cv::fillPoly(art_.rgb, points, colour);
    cv::fillPoly(art_.solid, points, 255);
  }
  void ellipse(const cv::Point2d& centre, double rx, double ry, const cv::Scalar& colour) {
    const cv::Size axes(std::max(1, px(rx)), std::max(1, px(ry)));
    cv::ellipse(art_.rgb, at(centre), axes, 0, 0, 360, colour, cv::FILLED);
    cv::ellipse(art_.solid, at(centre), axes, 0, 0, 360, 255, cv::FILLED);
  }
  void line(const cv::Point2d& a, const cv::Point2d& b, double width, const cv::Scalar& colour) {
    const int w = std::max(1, px(width));
    cv::line(art_.rgb, at(a), at(b), colour, w);
    cv::line(art_.solid, at(a), at(b), 255, w);
  }
  Art take() { return art_; }

 private:
  int px(double v) const { return static_cast<int>(std::lround(v * size_)); }
  cv::Point at(const cv::Point2d& p) const { return {px(p.x), px(p.y)}; }
  int size_;
  Art art_;
};

// A stick figure as people draw it with one pen: limbs are strokes, head and torso rings that they take for
// filled, or strokes as well.
Art strokeFigure(Rng& rng, int long_side) {
  constexpr std::array kKinds = {BodyKind::kStick, BodyKind::kStick, BodyKind::kChild,
                                 BodyKind::kChild, BodyKind::kKid,   BodyKind::kEmoji};
  const BipedPlan plan = sampleBipedPlan(rng, kKinds[rng.below(kKinds.size())]);
  cv::Rect2d box(plan.head.x(), plan.head.y(), 0, 0);
  const auto hold = [&](const Eigen::Vector2d& p, double r) {
    box |= cv::Rect2d(p.x() - r, p.y() - r, 2 * r, 2 * r);
  };
  const double head = rng.uniform(.8, 1.1) * std::max(.09, plan.head_height / 2);
  hold(plan.head, head);
  for (const auto* limbs : {&plan.arms, &plan.legs})
    for (const LimbPlan& limb : *limbs)
      for (const Eigen::Vector2d& p : {limb.root, limb.middle, limb.end}) hold(p, .06);
  const double scale = (long_side - 8) / std::max(box.width, box.height);
  const cv::Size size(cvCeil(box.width * scale) + 8, cvCeil(box.height * scale) + 8);
  Art art{cv::Mat(size, CV_8UC3, cv::Scalar::all(255)), cv::Mat::zeros(size, CV_8U), true};
  const auto px = [&](const Eigen::Vector2d& p) {
    return cv::Point(cvRound((p.x() - box.x) * scale) + 4, cvRound((p.y() - box.y) * scale) + 4);
  };
  const double dark = rng.uniform(5, 120);
  const bool one_colour = rng.chance(.7);
  const cv::Scalar ink = rng.chance(.6) ? cv::Scalar::all(dark) : randomRgb(rng, 5, 190);
  const int width =
      std::max(1, cvRound(long_side * (rng.chance(.4) ? rng.uniform(.005, .015) : rng.uniform(.015, .055))));
  const auto colour = [&] { return one_colour ? ink : randomRgb(rng, 5, 190); };
  const auto stroke = [&](std::vector<cv::Point> points, bool closed, const cv::Scalar& c) {
    if (closed) cv::fillPoly(art.solid, points, 255);
    cv::polylines(art.rgb, points, closed, c, width, cv::LINE_AA);
    cv::polylines(art.solid, points, closed, 255, width);
  };
  const auto ring = [&](const Eigen::Vector2d& at, double rx, double ry, const cv::Scalar& c) {
    std::vector<cv::Point> points;
    const double wobble = rng.uniform(0, .08), phase = rng.uniform(0, 6), start = rng.uniform(0, 6),
                 round = 2 * kPi * rng.uniform(.94, 1.03);
    for (int i = 0; i <= 30; ++i) {
      const double a = start + round * i / 30, r = 1 + wobble * std::sin(3 * a + phase);
      points.push_back(px(at + Eigen::Vector2d(r * rx * std::cos(a), r * ry * std::sin(a))));
    }
    cv::fillPoly(art.solid, points, 255);
    if (rng.chance(.15)) cv::fillPoly(art.rgb, points, c);
    stroke(points, false, c);
  };
  const auto limbs = [&](const std::array<LimbPlan, 2>& pair, const Eigen::Vector2d* root, bool legs) {
    const cv::Scalar c = colour();
    for (const LimbPlan& limb : pair) {
      const Eigen::Vector2d from = root != nullptr ? *root : limb.root;
      stroke({px(from), px(limb.middle), px(limb.end)}, false, c);
      const Eigen::Vector2d along = (limb.end - limb.middle).normalized(), across(-along.y(), along.x());
      if (legs ? rng.chance(.6) : rng.chance(.15))
        stroke({px(limb.end), px(limb.end + across * (limb.end.x() > from.x() ? -.06 : .06))}, false, c);
      if (!legs && rng.chance(.3))
        for (const double spread : {-.8, 0., .8})
          stroke({px(limb.end), px(limb.end + .05 * (along + spread * across).normalized())}, false, c);
      if (!legs && rng.chance(.1)) ring(limb.end, .035, .035, c);
    }
  };
  const double trunk = rng.uniform();
  const bool line = trunk < .5;
  limbs(plan.arms, line ? &plan.neck : nullptr, false);
  limbs(plan.legs, line ? &plan.pelvis : nullptr, true);
  const Eigen::Vector2d shoulders = plan.chest_right * std::max(.06, plan.top),
                        hips = plan.right * std::max(.06, plan.bottom);
  const cv::Scalar c = colour();
  if (line) {
    const Eigen::Vector2d up = (plan.neck - plan.head).normalized();
    stroke({px(plan.head + head * up), px(plan.neck), px(plan.middle), px(plan.pelvis)}, false, c);
  } else if (trunk < .8) {
    const double top = rng.chance(.5) ? 0 : 1, flare = rng.uniform(1, 2.2);
    stroke({px(plan.neck - top * shoulders), px(plan.neck + top * shoulders), px(plan.pelvis + flare * hips),
            px(plan.pelvis - flare * hips)},
           true, c);
  } else {
    ring((plan.neck + plan.pelvis) / 2, std::max(.07, plan.waist), .55 * (plan.pelvis - plan.neck).norm(), c);
  }
  ring(plan.head, head, head * rng.uniform(.85, 1.2), colour());
  const Eigen::Vector2d eye = .35 * head * plan.head_right;
  const int dot = std::max(1, width / 2);
  if (rng.chance(.8))
    for (const double side : {-1., 1.}) cv::circle(art.rgb, px(plan.head + side * eye), dot, ink, cv::FILLED);
  if (rng.chance(.8))
    cv::ellipse(art.rgb, px(plan.head + .3 * head * Eigen::Vector2d(0, 1)),
                {std::max(1, cvRound(.45 * head * scale)), std::max(1, cvRound(.3 * head * scale))}, 0, 20,
                160, ink, std::max(1, width / 2));
  if (rng.chance(.4))
    for (int i = 0, hairs = 3 + static_cast<int>(rng.below(12)); i < hairs; ++i) {
      const double a = kPi * (1 + rng.uniform(0, 1));
      const Eigen::Vector2d out(std::cos(a), std::sin(a));
      stroke({px(plan.head + head * out), px(plan.head + head * rng.uniform(1.1, 1.5) * out)}, false, ink);
    }
  return art;
}

Art house(Rng& rng, int size) {
  Easel e(size);
  const double left = rng.uniform(.05, .2), right = 1 - left, roof = rng.uniform(.3, .5);
  e.polygon({{left, roof}, {right, roof}, {right, .98}, {left, .98}}, randomRgb(rng, 120));
  e.polygon({{left - .05, roof}, {.5, .03}, {right + .05, roof}}, randomRgb(rng));
  const double door = rng.uniform(.3, .6);
  e.polygon({{door, .7}, {door + .14, .7}, {door + .14, .98}, {door, .98}}, randomRgb(rng));
  for (const double x : {left + .08, right - .24})
    e.polygon({{x, roof + .08}, {x + .16, roof + .08}, {x + .16, roof + .22}, {x, roof + .22}},
              randomRgb(rng));
  for (const double x : {left + .16, right - .16}) {
    e.line({x, roof + .08}, {x, roof + .22}, .012, {30, 30, 30});
    e.line({x - .08, roof + .15}, {x + .08, roof + .15}, .012, {30, 30, 30});
  }
  if (rng.chance(.5)) e.polygon({{.68, .08}, {.76, .08}, {.76, .3}, {.68, .22}}, randomRgb(rng));
  return e.take();
}

Art tree(Rng& rng, int size) {
  Easel e(size);
  const double half = rng.uniform(.03, .09);
  e.polygon({{.5 - half, .5}, {.5 + half, .5}, {.5 + half, .99}, {.5 - half, .99}}, randomRgb(rng, 40, 160));
  const cv::Scalar leaves =
      rng.chance(.7) ? cv::Scalar(rng.uniform(20, 140), rng.uniform(110, 220), rng.uniform(20, 110))
                     : randomRgb(rng);
  if (rng.chance(.3)) {
    for (int i = 0; i < 3; ++i)
      e.polygon({{.5, .02 + .18 * i}, {.72 + .05 * i, .34 + .18 * i}, {.28 - .05 * i, .34 + .18 * i}},
                leaves);
  } else {
    const int puffs = 1 + static_cast<int>(rng.below(5));
    for (int i = 0; i < puffs; ++i)
      e.ellipse({.5 + rng.uniform(-.2, .2), .33 + rng.uniform(-.15, .15)}, rng.uniform(.15, .27),
                rng.uniform(.15, .25), leaves);
  }
  return e.take();
}

Art sun(Rng& rng, int size) {
  Easel e(size);
  const cv::Scalar colour =
      rng.chance(.7) ? cv::Scalar(250, rng.uniform(170, 235), rng.uniform(20, 90)) : randomRgb(rng);
  const int rays = static_cast<int>(rng.below(15));
  const double r = rng.uniform(.2, .32), width = rng.uniform(.01, .05);
  for (int i = 0; i < rays; ++i) {
    const double a = 2 * kPi * i / rays;
    e.line({.5 + 1.15 * r * std::cos(a), .5 + 1.15 * r * std::sin(a)},
           {.5 + .47 * std::cos(a), .5 + .47 * std::sin(a)}, width, colour);
  }
  e.ellipse({.5, .5}, r, r, colour);
  if (rng.chance(.3)) {
    for (const double x : {.44, .56}) e.ellipse({x, .46}, .02, .03, {30, 30, 30});
    e.line({.43, .57}, {.57, .57}, .015, {30, 30, 30});
  }
  return e.take();
}

Art cloud(Rng& rng, int size) {
  Easel e(size);
  const cv::Scalar colour =
      rng.chance(.6) ? cv::Scalar(rng.uniform(190, 250), rng.uniform(215, 250), 250) : randomRgb(rng);
  const int puffs = 3 + static_cast<int>(rng.below(4));
  for (int i = 0; i < puffs; ++i)
    e.ellipse({.2 + .6 * i / (puffs - 1), .5 + rng.uniform(-.08, .08)}, rng.uniform(.13, .2),
              rng.uniform(.1, .2), colour);
  return e.take();
}

Art flower(Rng& rng, int size) {
  Easel e(size);
  e.line({.5, .4}, {.5 + rng.uniform(-.1, .1), .98}, rng.uniform(.02, .06), {60, 150, 60});
  const cv::Scalar colour = randomRgb(rng);
  const int petals = 5 + static_cast<int>(rng.below(4));
  for (int i = 0; i < petals; ++i)
    e.ellipse({.5 + .17 * std::cos(2 * kPi * i / petals), .25 + .17 * std::sin(2 * kPi * i / petals)}, .1, .1,
              colour);
  e.ellipse({.5, .25}, .09, .09, randomRgb(rng));
  return e.take();
}

Art heart(Rng& rng, int size) {
  Easel e(size);
  const cv::Scalar colour =
      rng.chance(.7) ? cv::Scalar(rng.uniform(190, 250), rng.uniform(20, 110), rng.uniform(40, 140))
                     : randomRgb(rng);
  e.ellipse({.33, .33}, .19, .2, colour);
  e.ellipse({.67, .33}, .19, .2, colour);
  e.polygon({{.16, .42}, {.5, .9}, {.84, .42}, {.5, .3}}, colour);
  return e.take();
}

Art ball(Rng& rng, int size) {
  Easel e(size);
  e.ellipse({.5, .5}, .46, .46, randomRgb(rng));
  if (rng.chance(.5)) e.ellipse({.5, .5}, .46, .18, randomRgb(rng));
  return e.take();
}

Art star(Rng& rng, int size) {
  Easel e(size);
  const cv::Scalar colour = randomRgb(rng);
  const double turn = rng.uniform(0, kPi), inner = rng.uniform(.15, .3);
  const auto at = [&](int i) {
    const double r = i % 2 == 0 ? .47 : inner, a = turn + kPi * i / 5;
    return cv::Point2d(.5 + r * std::cos(a), .5 + r * std::sin(a));
  };
  for (int i = 0; i < 10; i += 2) e.polygon({{.5, .5}, at(i + 9), at(i), at(i + 1)}, colour);
  return e.take();
}

Art car(Rng& rng, int size) {
  Easel e(size);
  const cv::Scalar colour = randomRgb(rng), dark = randomRgb(rng, 10, 90);
  const double roof = rng.uniform(.3, .42);
  e.polygon({{.02, .55}, {.98, .55}, {.98, .78}, {.02, .78}}, colour);
  e.polygon({{.2, .56}, {.3, roof}, {.7, roof}, {.82, .56}}, colour);
  e.polygon({{.27, .54}, {.34, roof + .04}, {.49, roof + .04}, {.49, .54}}, randomRgb(rng, 120));
  for (const double x : {.24, .76}) e.ellipse({x, .78}, .11, .11, dark);
  return e.take();
}

Art mountains(Rng& rng, int size) {
  Easel e(size);
  for (int i = 0, count = 2 + static_cast<int>(rng.below(3)); i < count; ++i) {
    const double x = rng.uniform(.2, .8), half = rng.uniform(.15, .4);
    e.polygon({{x - half, .98}, {x, rng.uniform(.2, .6)}, {x + half, .98}}, randomRgb(rng));
  }
  return e.take();
}

Art rainbow(Rng& rng, int size) {
  Easel e(size);
  const int bands = 3 + static_cast<int>(rng.below(5));
  const double width = rng.uniform(.02, .06);
  for (int band = 0; band < bands; ++band) {
    const cv::Scalar colour = randomRgb(rng);
    const double r = .47 - band * width;
    for (int i = 0; i < 24; ++i) {
      const double a = kPi * (1 + i / 24.), b = kPi * (1 + (i + 1) / 24.);
      e.line({.5 + r * std::cos(a), .6 + r * std::sin(a)}, {.5 + r * std::cos(b), .6 + r * std::sin(b)},
             width, colour);
    }
  }
  return e.take();
}

Art fence(Rng& rng, int size) {
  Easel e(size);
  const cv::Scalar colour = randomRgb(rng);
  const int posts = 4 + static_cast<int>(rng.below(6));
  for (const double y : {.6, .8}) e.line({.02, y}, {.98, y}, .03, colour);
  for (int i = 0; i < posts; ++i)
    e.line({.05 + .9 * i / (posts - 1), .45}, {.05 + .9 * i / (posts - 1), .97}, .05, colour);
  return e.take();
}

Art balloon(Rng& rng, int size) {
  Easel e(size);
  e.line({.5, .5}, {.5 + rng.uniform(-.15, .15), .98}, .012, {60, 60, 60});
  e.ellipse({.5, .3}, rng.uniform(.18, .25), rng.uniform(.22, .28), randomRgb(rng));
  return e.take();
}

Art furniture(Rng& rng, int size) {
  Easel e(size);
  const cv::Scalar colour = randomRgb(rng);
  const double top = rng.uniform(.35, .55);
  e.polygon({{.05, top}, {.95, top}, {.95, top + .08}, {.05, top + .08}}, colour);
  for (const double x : {.12, .88}) e.line({x, top}, {x, .98}, .06, colour);
  if (rng.chance(.5)) e.line({.12, .04}, {.12, top}, .06, colour);
  return e.take();
}

// Said by the figure.
Art bubble(Rng& rng, int size) {
  Easel e(size);
  const cv::Scalar colour = rng.chance(.6) ? cv::Scalar::all(250) : randomRgb(rng, 150);
  e.ellipse({.5, .35}, .46, .3, {30, 30, 30});
  e.ellipse({.5, .35}, .445, .285, colour);
  e.polygon({{.3, .58}, {.45, .6}, {.25, .9}}, colour);
  for (int line = 0; line < 2; ++line) {
    double x = .2;
    while (x < .75) {
      const double to = x + rng.uniform(.04, .14);
      e.line({x, .28 + .14 * line}, {to, .28 + .14 * line + rng.uniform(-.03, .03)}, .025, {30, 30, 30});
      x = to + .04;
    }
  }
  return e.take();
}

Art scribble(Rng& rng, int size) {
  Easel e(size);
  const cv::Scalar colour = randomRgb(rng, 10, 200);
  cv::Point2d at(rng.uniform(.1, .9), rng.uniform(.1, .9));
  const double width = rng.uniform(.01, .04);
  for (int i = 0, count = 3 + static_cast<int>(rng.below(20)); i < count; ++i) {
    const cv::Point2d to(std::clamp(at.x + rng.normal(0, .25), .02, .98),
                         std::clamp(at.y + rng.normal(0, .2), .02, .98));
    e.line(at, to, width, colour);
    at = to;
  }
  return e.take();
}

// A written name.
Art letters(Rng& rng, int size) {
  static constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPRSTUVWabdeghiklmnoprstu0123456789";
  std::string name;
  const int count = 1 + static_cast<int>(rng.below(8));
  for (int i = 0; i < count; ++i) name += kLetters[rng.below(kLetters.size())];
  constexpr std::array kFaces = {cv::FONT_HERSHEY_SIMPLEX, cv::FONT_HERSHEY_DUPLEX,
                                 cv::FONT_HERSHEY_SCRIPT_SIMPLEX, cv::FONT_HERSHEY_COMPLEX_SMALL};
  const int face = kFaces[rng.below(kFaces.size())], thickness = 1 + static_cast<int>(rng.below(3));
  int baseline = 0;
  const cv::Size plain = cv::getTextSize(name, face, 1, thickness, &baseline);
  const double scale = std::min(.9 * size / plain.width, size / 90.);
  Art art{cv::Mat(size, size, CV_8UC3, cv::Scalar::all(255)), cv::Mat::zeros(size, size, CV_8U)};
  const cv::Point at(size / 20, size / 2);
  cv::putText(art.rgb, name, at, face, scale, randomRgb(rng, 10, 160), thickness);
  cv::putText(art.solid, name, at, face, scale, 255, thickness);
  return art;
}

// As an unsteady hand draws it.
Art wobbled(Rng& rng, const Art& art, double size_px) {
  cv::Mat dx = smoothNoise(rng, art.solid.size(), 14) * size_px,
          dy = smoothNoise(rng, art.solid.size(), 14) * size_px;
  for (int y = 0; y < dx.rows; ++y)
    for (int x = 0; x < dx.cols; ++x) {
      dx.at<float>(y, x) += static_cast<float>(x);
      dy.at<float>(y, x) += static_cast<float>(y);
    }
  Art out;
  out.strokes = art.strokes;
  cv::remap(art.rgb, out.rgb, dx, dy, cv::INTER_NEAREST, cv::BORDER_CONSTANT, cv::Scalar::all(255));
  cv::remap(art.solid, out.solid, dx, dy, cv::INTER_NEAREST, cv::BORDER_CONSTANT, cv::Scalar(0));
  return out;
}

}  // namespace

cv::Scalar randomRgb(Rng& rng, double low, double high) {
  return {rng.uniform(low, high), rng.uniform(low, high), rng.uniform(low, high)};
}

cv::Mat smoothNoise(Rng& rng, const cv::Size& size, int cell) {
  cv::Mat coarse(size.height / cell + 3, size.width / cell + 3, CV_32F), fine;
  for (int y = 0; y < coarse.rows; ++y)
    for (int x = 0; x < coarse.cols; ++x) coarse.at<float>(y, x) = static_cast<float>(rng.normal());
  cv::resize(coarse, fine, {coarse.cols * cell, coarse.rows * cell}, 0, 0, cv::INTER_LINEAR);
  return fine(cv::Rect(cell, cell, size.width, size.height)).clone();
}

Art figureArt(Rng& rng, const PageOptions& options, int long_side) {
  if (rng.chance(.13)) return strokeFigure(rng, long_side);
  if (!options.drawings.empty() && rng.chance(options.drawn_share)) {
    const SmallDrawing& drawing =
        options.drawings[rng.below(static_cast<std::uint32_t>(options.drawings.size()))];
    const WarpedDrawing w = warpedDrawing(rng, drawing, 0, long_side, 4);
    return artOf(w.width, w.height, w.solid, w.colours);
  }
  if (rng.chance(.2)) {
    Art stick = artOf(figurePlan("biped").draw(rng, static_cast<int>(BodyKind::kStick)).scene, long_side);
    if (rng.chance(.7)) stick.rgb.setTo(randomRgb(rng, 10, 160), stick.solid);
    return stick;
  }
  const FigurePlan& plan = figurePlan(rng.chance(.8) ? "biped" : "quadruped");
  return artOf(plan.draw(rng, sampleKind(rng, plan)).scene, long_side);
}

Art thingArt(Rng& rng, int long_side) {
  static constexpr std::array kThings = {house,   house, tree,    tree,      sun,    cloud,   flower,
                                         heart,   ball,  letters, letters,   star,   car,     mountains,
                                         rainbow, fence, balloon, furniture, bubble, scribble};
  if (rng.chance(.15)) {
    const Scene scene = figurePlan("biped").drawOther(rng);
    if (!scene.empty()) return artOf(scene, long_side);
  }
  return kThings[rng.below(kThings.size())](rng, long_side);
}

Pens randomPens(Rng& rng) {
  Pens pens;
  const double r = rng.uniform();
  pens.kind = r < .25   ? Pens::Kind::kPaint
              : r < .45 ? Pens::Kind::kPrint
              : r < .8  ? Pens::Kind::kLines
                        : Pens::Kind::kCrayon;
  pens.line_px = rng.chance(.5) ? rng.uniform(.8, 2) : rng.uniform(2, 6);
  const double dark = rng.uniform(10, 150);
  pens.ink = rng.chance(.7) ? cv::Scalar(dark, dark, dark + rng.uniform(0, 30)) : randomRgb(rng, 10, 190);
  pens.strength =
      pens.kind == Pens::Kind::kLines ? (rng.chance(.5) ? 0 : rng.uniform(.1, .9)) : rng.uniform(.4, 1);
  pens.gaps = rng.chance(.4) ? rng.uniform(0, .15) : 0;
  pens.grain = rng.uniform(.05, .45);
  if (rng.chance(.35)) pens.hatch_px = rng.uniform(2.5, 8);
  if (rng.chance(.5)) pens.wobble_px = rng.uniform(0, 1.6);
  if (pens.kind == Pens::Kind::kLines && rng.chance(.3)) {  // a thin, pale pencil
    const double pale = rng.uniform(110, 190);
    pens.ink = {pale, pale, pale};
    pens.line_px = rng.uniform(.8, 1.6);
  }
  return pens;
}

Pens strokePens(Rng& rng, Pens pens) {
  pens.kind = rng.chance(.75) ? Pens::Kind::kPrint : Pens::Kind::kCrayon;
  pens.strength = rng.uniform(.6, 1);
  pens.grain = rng.uniform(.02, .2);
  pens.hatch_px = 0;
  return pens;
}

void drawArt(Rng& rng, const Pens& pens, const Art& steady, int x, int y, cv::Mat& page) {
  const Art art = pens.wobble_px > 0 ? wobbled(rng, steady, pens.wobble_px) : steady;
  const cv::Rect place = cv::Rect(x, y, art.rgb.cols, art.rgb.rows) & cv::Rect(0, 0, page.cols, page.rows);
  if (place.empty()) return;
  const cv::Rect from(place.x - x, place.y - y, place.width, place.height);
  // How much of the paper is covered by colour, and the lines, both 0…1 over the whole of the art.
  cv::Mat cover, lines = cv::Mat::zeros(art.solid.size(), CV_32F);
  art.solid.convertTo(cover, CV_32F, 1 / 255.);
  cv::GaussianBlur(cover, cover, {3, 3}, .6);
  if (pens.kind == Pens::Kind::kCrayon) {
    const cv::Mat noise = smoothNoise(rng, cover.size(), 1 + static_cast<int>(rng.below(3)));
    cover.setTo(0, noise < static_cast<float>(2 * pens.grain - 1));
  }
  if (pens.hatch_px > 0) {
    const double angle = rng.uniform(0, kPi), step = 2 * kPi / pens.hatch_px;
    const cv::Mat sway = smoothNoise(rng, cover.size(), 12);
    for (int row = 0; row < cover.rows; ++row)
      for (int col = 0; col < cover.cols; ++col)
        cover.at<float>(row, col) *= static_cast<float>(
            .5 + .5 * std::tanh(2.5 * std::sin(step * (col * std::cos(angle) + row * std::sin(angle)) +
                                               .8 * static_cast<double>(sway.at<float>(row, col)))));
  }
  if (pens.kind == Pens::Kind::kLines ||
      (pens.kind == Pens::Kind::kCrayon && !art.strokes && rng.chance(.5))) {
    cv::Mat shown = art.rgb.clone(), edges = cv::Mat::zeros(art.solid.size(), CV_8U);
    shown.setTo(cv::Scalar::all(255), art.solid == 0);
    std::vector<cv::Mat> channels;
    cv::split(shown, channels);
    channels.push_back(art.solid);
    for (const cv::Mat& channel : channels) {
      cv::Mat steep;
      cv::morphologyEx(channel, steep, cv::MORPH_GRADIENT, cv::Mat::ones(2, 2, CV_8U));
      edges |= steep > 40;
    }
    const int grow = std::max(1, static_cast<int>(std::lround(pens.line_px)));
    if (grow > 1) cv::dilate(edges, edges, cv::getStructuringElement(cv::MORPH_ELLIPSE, {grow, grow}));
    edges.convertTo(lines, CV_32F, 1 / 255.);
    cv::GaussianBlur(lines, lines, {3, 3}, .6);
    if (pens.line_px < 1.3) lines *= pens.line_px / 1.5;
    const cv::Mat pressure = smoothNoise(rng, lines.size(), 9 + static_cast<int>(rng.below(20)));
    if (pens.gaps > 0) lines.setTo(0, pressure > static_cast<float>(1.9 - 6 * pens.gaps));
  }
  for (int row = 0; row < place.height; ++row) {
    for (int col = 0; col < place.width; ++col) {
      const cv::Point at(from.x + col, from.y + row);
      cv::Vec3b& p = page.at<cv::Vec3b>(place.y + row, place.x + col);
      const cv::Vec3b& c = art.rgb.at<cv::Vec3b>(at);
      const float a = cover.at<float>(at), l = lines.at<float>(at);
      for (int k = 0; k < 3; ++k) {
        const double opaque = pens.strength * c[k] + (1 - pens.strength) * p[k];
        const double printed = p[k] * (1 - pens.strength * (1 - c[k] / 255.));
        double v = p[k] + a * ((pens.kind == Pens::Kind::kPaint ? opaque : printed) - p[k]);
        v += l * (pens.ink[k] - v) * .9;
        p[k] = cv::saturate_cast<std::uint8_t>(v);
      }
    }
  }
}

}  // namespace skel
