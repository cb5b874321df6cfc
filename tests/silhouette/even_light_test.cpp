#include "libskel/silhouette/even_light.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "libskel/core/rng.h"
#include "tests/support/catch.h"

using namespace skel;

namespace {

using Rgb = Eigen::Array3d;
using Painter = std::function<Rgb(double x, double y)>;

constexpr int kWidth = 420, kHeight = 520;

// A figure with a trunk, a head and limbs: how far (x, y) is from its outline, negative inside.
double distanceToPerson(double x, double y) {
  const auto capsule = [&](double x0, double y0, double x1, double y1, double radius) {
    const double dx = x1 - x0, dy = y1 - y0;
    const double t = std::clamp(((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy + 1e-12), 0.0, 1.0);
    return std::hypot(x - x0 - t * dx, y - y0 - t * dy) - radius;
  };
  return std::min({capsule(210, 130, 210, 130, 50), capsule(210, 200, 210, 310, 55),
                   capsule(210, 220, 100, 260, 16), capsule(210, 220, 320, 260, 16),
                   capsule(190, 320, 160, 440, 20), capsule(230, 320, 260, 440, 20)});
}

Rgb outlinedPerson(const Rgb& fill, double x, double y) {
  const double d = distanceToPerson(x, y);
  if (d < -4) return fill;
  return d <= 0 ? Rgb(40, 40, 45) : Rgb(255, 255, 255);
}

// What is drawn on white, as it looks on paper in this light.
Image photographed(const Painter& drawn, const Painter& light) {
  Rng rng(3);
  Image image(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const Rgb c = drawn(x, y) * light(x, y) * (1 + rng.normal(0, 0.01));
      for (int k = 0; k < 3; ++k)
        image.pixel(x, y)[k] = static_cast<std::uint8_t>(std::clamp(c[k] + 0.5, 0.0, 255.0));
      image.pixel(x, y)[3] = 255;
    }
  return image;
}

Silhouette person(const std::vector<RuledLine>& ruling = {}) {
  Plane8 mask(kHeight, kWidth);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) mask(y, x) = distanceToPerson(x, y) <= 0 ? 255 : 0;
  Silhouette silhouette = silhouetteFromMask(mask);
  silhouette.ruling = ruling;
  return silhouette;
}

Rgb at(const Image& image, int x, int y) {
  const std::uint8_t* p = image.pixel(x, y);
  return {double(p[0]), double(p[1]), double(p[2])};
}

// The mean of the 9×9 px around.
Rgb around(const Image& image, int x, int y) {
  Rgb sum = Rgb::Zero();
  for (int v = -4; v <= 4; ++v)
    for (int u = -4; u <= 4; ++u) sum += at(image, x + u, y + v) / 81;
  return sum;
}

double apart(const Rgb& a, const Rgb& b) { return (a - b).abs().maxCoeff(); }

Rgb lamp(double x, double y) {
  const double falls = 0.95 - 0.4 * (x / kWidth) * (0.4 + 0.6 * y / kHeight);
  return {falls * 0.92, falls * 0.86, falls * 0.74};
}

constexpr double kAlike = 6;  // levels

}  // namespace

TEST_CASE("a figure in the light of a lamp gets the colours it was drawn in, its paper becomes white") {
  const Painter drawn = [](double x, double y) {
    return outlinedPerson(y < 180   ? Rgb(255, 255, 255)
                          : y < 320 ? Rgb(200, 60, 50)
                                    : Rgb(60, 110, 200),
                          x, y);
  };
  const Image photo = photographed(drawn, lamp);
  const Image even = evenLight(photo, person());
  REQUIRE(!even.empty());
  CHECK(apart(around(photo, 210, 120), {255, 255, 255}) > 40);
  CHECK(apart(around(even, 210, 120), {255, 255, 255}) < kAlike);
  CHECK(apart(around(even, 180, 250), {200, 60, 50}) < kAlike);
  CHECK(apart(around(even, 250, 250), {200, 60, 50}) < kAlike);
  CHECK(apart(around(even, 163, 420), {60, 110, 200}) < kAlike);
  CHECK(apart(around(even, 258, 420), {60, 110, 200}) < kAlike);
  CHECK(apart(around(even, 210, 440), {255, 255, 255}) < kAlike);  // the paper between the legs
}

TEST_CASE("a shadow that was cast across a filled figure leaves neither a dark half nor an edge") {
  const double soft = GENERATE(4.0, 25.0);
  const Rgb shade =
      GENERATE(Rgb(0.55, 0.55, 0.55), Rgb(0.52, 0.56, 0.64));  // a clear sky shines into shadows
  const Rgb fill(120, 190, 90);
  constexpr double kStep = 0.45 * 0.88 * 190;  // that the shadow makes
  const Painter light = [soft, shade](double x, double y) -> Rgb {
    const double shadow = std::clamp(0.5 + (x + 0.2 * y - 260) / soft, 0.0, 1.0);
    return Rgb(0.9, 0.88, 0.84) * (1 - (1 - shade) * shadow);
  };
  const Image even = evenLight(
      photographed([&](double x, double y) { return outlinedPerson(fill, x, y); }, light), person());
  REQUIRE(!even.empty());
  for (const int x : {170, 250}) CHECK(apart(around(even, x, 280), fill) < kStep / 5);
  for (const int x : {120, 300}) CHECK(apart(around(even, x, 252), fill) < kStep / 5);
}

TEST_CASE("a grey that was drawn is no shadow") {
  const Image even =
      evenLight(photographed(
                    [](double x, double y) {
                      return outlinedPerson(x < 210 ? Rgb(150, 150, 150) : Rgb(90, 90, 95), x, y);
                    },
                    lamp),
                person());
  REQUIRE(!even.empty());
  CHECK(apart(around(even, 180, 280), {150, 150, 150}) < kAlike);
  CHECK(apart(around(even, 240, 280), {90, 90, 95}) < kAlike);
}

TEST_CASE("ruling goes from the paper within the figure, ink on it stays, and so does what covers it") {
  constexpr int kPeriod = 20;
  const bool upright = GENERATE(false, true);
  std::vector<RuledLine> ruling;
  const int across = upright ? kWidth : kHeight, along = upright ? kHeight : kWidth;
  for (int p = kPeriod; p < across; p += kPeriod) {
    RuledLine line;
    line.upright = upright;
    for (const double end : {0.0, along - 1.0})
      line.points.push_back(upright ? Eigen::Vector2d(p, end) : Eigen::Vector2d(end, p));
    ruling.push_back(line);
  }
  const auto isRuled = [&](int x, int y) { return (upright ? x : y) % kPeriod == 0; };
  const auto isStroke = [](double x, double y) { return std::abs(x - y - 0.3) < 2.5; };  // crosses both ways
  const Painter page = [&](double x, double y) -> Rgb {
    if (distanceToPerson(x, y) < -4 && y > 330) return {200, 60, 50};  // opaque
    const Rgb drawn = isStroke(x, y) && distanceToPerson(x, y) < 0 ? Rgb(40, 40, 45)
                                                                   : outlinedPerson({255, 255, 255}, x, y);
    return drawn * (isRuled(int(x), int(y)) ? Rgb(0.6, 0.72, 0.88) : Rgb(1, 1, 1));
  };
  const Image photo = photographed(page, [](double, double) { return Rgb(0.9, 0.88, 0.84); });
  const Image even = evenLight(photo, person(ruling));
  REQUIRE(!even.empty());
  int lines = 0, left = 0, strokes = 0, faded = 0, covered = 0, changed = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      if (!isRuled(x, y) || distanceToPerson(x, y) > -12) continue;
      if (y > 340) {
        ++covered, changed += apart(at(even, x, y), {200, 60, 50}) > 20;
      } else if (isStroke(x, y)) {
        ++strokes, faded += at(even, x, y).mean() > 70;
      } else if (std::abs(x - y) > 8 && y < 320) {
        ++lines, left += at(even, x, y).minCoeff() < 235;
      }
    }
  REQUIRE(std::min({lines, strokes, covered}) > 10);
  CHECK(left < 0.02 * lines);
  CHECK(faded == 0);
  CHECK(changed == 0);
}

TEST_CASE("what is no photographed page stays as it is") {
  const Painter drawn = [](double x, double y) { return outlinedPerson({230, 180, 150}, x, y); };
  const Image page = photographed(drawn, lamp);
  SECTION("a picture with alpha") {
    Image clear = page;
    for (int x = 0; x < kWidth; ++x) clear.pixel(x, 0)[3] = 0;
    CHECK(evenLight(clear, person()).empty());
  }
  SECTION("art on white, on a colour that runs into another") {
    for (const bool graded : {false, true}) {
      Image flat(kWidth, kHeight);
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const Rgb c = distanceToPerson(x, y) <= 0 ? drawn(x, y)
                        : graded                    ? Rgb(200 + y / 10., 215 + y / 20., 240)
                                                    : Rgb(255, 255, 255);
          for (int k = 0; k < 3; ++k) flat.pixel(x, y)[k] = static_cast<std::uint8_t>(c[k] + 0.5);
          flat.pixel(x, y)[3] = 255;
        }
      CHECK(evenLight(flat, person()).empty());
    }
  }
  SECTION("a scan on white") {
    CHECK(evenLight(photographed(drawn, [](double, double) { return Rgb(0.985, 0.985, 0.98); }), person())
              .empty());
  }
  SECTION("on grass") {
    CHECK(evenLight(photographed(
                        [&](double x, double y) -> Rgb {
                          return distanceToPerson(x, y) <= 0 ? drawn(x, y) : Rgb(90, 160, 60);
                        },
                        lamp),
                    person())
              .empty());
  }
}
