#include "libskel/video/outline_distance.h"

#include <cmath>

#include "libskel/core/rng.h"
#include "libskel/video/figure_in_frame.h"
#include "libskel/video/low_pass.h"
#include "libskel/video/normalize_figure.h"
#include "tests/support/catch.h"

using namespace skel;

namespace {

Plane8 box(int x, int y, int width, int height) {
  Plane8 mask = Plane8::Zero(60, 80);
  mask.block(y, x, height, width).setConstant(255);
  return mask;
}

// By all pairs of points.
double slowDistance(const FrameOutline& a, const FrameOutline& b) {
  const auto one_way = [](const FrameOutline& from, const FrameOutline& to) {
    double farthest = 0;
    for (const Eigen::Vector2i& p : from.points) {
      double nearest = 1e9;
      for (const Eigen::Vector2i& q : to.points) nearest = std::min(nearest, (p - q).cast<double>().norm());
      farthest = std::max(farthest, nearest);
    }
    return farthest;
  };
  return std::max(one_way(a, b), one_way(b, a));
}

}  // namespace

TEST_CASE("an outline is what has a neighbour outside, also at the picture's border") {
  const FrameOutline outline = outlineOf(box(10, 20, 5, 4));
  CHECK(outline.points.size() == 14);
  CHECK(outline.area_px == 20);
  CHECK(outlineOf(box(0, 0, 80, 60)).points.size() == 276);
  CHECK(outlineOf(Plane8::Zero(4, 4)).points.empty());
}

TEST_CASE("distances by transforms are those by pairs of points") {
  Rng rng(5);
  std::vector<FrameOutline> outlines;
  for (int i = 0; i < 6; ++i) {
    Plane8 mask = Plane8::Zero(60, 80);
    for (int k = 0; k < 4; ++k)
      mask.block(rng.below(40), rng.below(60), 1 + rng.below(19), 1 + rng.below(19)).setConstant(255);
    outlines.push_back(outlineOf(mask));
  }
  const Eigen::MatrixXd matrix = distanceMatrix(outlines);
  const Eigen::VectorXd successive = successiveDistances(outlines);
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b) {
      CHECK(matrix(a, b) == Approx(slowDistance(outlines[a], outlines[b])).margin(1e-4));
      if (b == a + 1) CHECK(matrix(a, b) == Approx(successive(a)));
    }
  CHECK(distanceMatrix(outlines, 1) == matrix);
}

TEST_CASE("a frame without a figure is as far away as can be") {
  const FrameOutline none = outlineOf(Plane8::Zero(60, 80)), some = outlineOf(box(1, 1, 5, 5));
  CHECK(hausdorffDistance(none, none) == 0);
  CHECK(hausdorffDistance(none, some) == Approx(100));
  CHECK(distanceMatrix({none, some})(0, 1) == Approx(100));
}

TEST_CASE("key frames are the first, the last, and those after a large change") {
  const auto keys = [](std::vector<double> d, double threshold) {
    return keyFrames(Eigen::Map<Eigen::VectorXd>(d.data(), Eigen::Index(d.size())), threshold);
  };
  CHECK(keys({1, 10, 2, 8, 1}, 0.5) == std::vector<int>{0, 2, 4, 5});
  CHECK(keys({1, 10, 2, 8, 1}, 0.9) == std::vector<int>{0, 2, 5});
  CHECK(keys({0, 0, 0}, 0.5) == std::vector<int>{0, 3});
  CHECK(keys({}, 0.5) == std::vector<int>{0});
  CHECK(keys({3}, 0) == std::vector<int>{0, 1});
}

TEST_CASE("figures come to one size and to the middle, and back") {
  for (const Plane8& mask : {box(3, 30, 12, 20), box(40, 2, 36, 50)}) {
    const FrameOutline outline = outlineOf(mask);
    const FrameTransform t = normalizeFigure(outline, 400);
    CHECK(t.scale * t.scale * outline.area_px == Approx(400));
    CHECK((t.apply(t.invert({7, 9})) - Eigen::Vector2d(7, 9)).norm() < 1e-9);
    Image image(80, 60);
    for (int i = 0; i < 4800; ++i) image.rgba.row(i).setConstant(mask.data()[i]);
    const Image moved = transformed(image, t);
    double area = 0;
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (int y = 0; y < 60; ++y)
      for (int x = 0; x < 80; ++x)
        area += moved.pixel(x, y)[3] / 255., middle += moved.pixel(x, y)[3] / 255. * Eigen::Vector2d(x, y);
    CHECK(area == Approx(400).epsilon(0.05));
    CHECK((middle / area - Eigen::Vector2d(39.5, 29.5)).norm() < 3);
    CHECK(normalizeFigure(outline, 400).shift == t.shift);
  }
  CHECK(normalizeFigure(outlineOf(Plane8::Zero(5, 5)), 10).scale == 1);
}

TEST_CASE("a low-pass keeps the mean and what is slow, and takes noise away") {
  FloatPlane plane(37, 50);
  Rng rng(2);
  for (Eigen::Index i = 0; i < plane.size(); ++i) plane.data()[i] = float(100 + 20 * rng.normal());
  const FloatPlane smooth = lowPass(plane, 0.2);
  CHECK(smooth.mean() == Approx(plane.mean()).epsilon(0.01));
  CHECK((smooth - smooth.mean()).square().mean() < 0.2f * (plane - plane.mean()).square().mean());
  const FloatPlane flat = FloatPlane::Constant(9, 7, 42);
  CHECK((lowPass(flat, 0.3) - flat).abs().maxCoeff() < 1e-3f);
  FloatPlane ramp(20, 40);
  for (int x = 0; x < 40; ++x) ramp.col(x).setConstant(float(x));
  CHECK((lowPass(ramp, 0.5) - ramp).block(0, 6, 20, 28).abs().maxCoeff() < 0.1f);
  CHECK(lowPass(FloatPlane::Constant(1, 1, 3), 0.5)(0, 0) == Approx(3));
}

TEST_CASE("a figure that moves is found before a background that stands still") {
  std::vector<Image> frames;
  for (int f = 0; f < 7; ++f) {
    Image image(80, 60);
    for (int i = 0; i < 4800; ++i) image.rgba.row(i) << 200, std::uint8_t(i % 80), 90, 255;
    for (int y = 20; y < 50; ++y)
      for (int x = 10 * f; x < 10 * f + 10; ++x) image.pixel(x, y)[0] = 20;
    frames.push_back(image);
  }
  const Image background = stillBackground(frames);
  CHECK(int(background.pixel(35, 30)[0]) == 200);
  const Plane8 figure = foreground(frames[3], background);
  CHECK(figure(30, 35) == 255);
  CHECK(figure(30, 60) == 0);
  // 10 × 30 px, its corners rounded by the low-pass, to about a pixel all round.
  CHECK((figure > 0).count() > 8 * 28 - 12);
  CHECK((figure > 0).count() < 12 * 32);
  CHECK_FALSE(hasTransparency(frames[0]));
}
