#include "libskel/draw/canvas.h"

#include <string>
#include <utility>

#include "libskel/core/error.h"
#include "tests/support/catch.h"

using namespace skel;

namespace {

// Sum of what has been painted black on white, in pixels.
double ink(const Image& image) { return (255.0 - image.rgba.col(0).cast<double>()).sum() / 255; }

constexpr Color kBlack{0, 0, 0};

}  // namespace

TEST_CASE("shapes cover the area that they should, wherever they lie between pixels") {
  for (const double shift : {0.0, 0.3, 0.5}) {
    CAPTURE(shift);
    Image disc = blankImage(60, 60);
    drawDisc(disc, {30 + shift, 30}, 20, kBlack);
    CHECK(ink(disc) == Approx(1256.6).epsilon(0.005));
    Image ring = blankImage(60, 60);
    drawCircle(ring, {30 + shift, 30}, 20, 3, kBlack);
    CHECK(ink(ring) == Approx(2 * 3.1416 * 20 * 3).epsilon(0.01));
    Image line = blankImage(60, 60);
    drawLine(line, {10, 10 + shift}, {50, 40 + shift}, 4, kBlack);
    CHECK(ink(line) == Approx(50 * 4 + 12.57).epsilon(0.01));
    Image square = blankImage(60, 60);
    fillPolygons(square, {{{10 + shift, 10}, {40 + shift, 10}, {40 + shift, 40}, {10 + shift, 40}}}, kBlack);
    CHECK(ink(square) == Approx(900).epsilon(0.001));
    fillPolygons(square, {{{0, 0}}, {}}, kBlack);
    CHECK(ink(square) == Approx(900).epsilon(0.001));
  }
}

TEST_CASE("letters have their marks, composed or not, and take no more room by them") {
  const auto written = [](const std::string& text) {
    Image image = blankImage(120, 40);
    drawText(image, {10, 30}, text, 16, kBlack);
    return image;
  };
  for (const auto& [marked, plain] : {std::pair{"\xc3\xb6", "o"},
                                      {"\xc3\x89", "E"},
                                      {"\xc3\xa7", "c"},
                                      {"\xc5\x81", "L"},
                                      {"\xc5\xa1", "s"}}) {
    CAPTURE(plain);
    CHECK(ink(written(marked)) > ink(written(plain)) + 2);
    CHECK(textWidth(marked, 16) == textWidth(plain, 16));
  }
  CHECK((written("J\xc3\xb6rg").rgba == written("Jo\xcc\x88rg").rgba).all());
  CHECK((written("Wei\xc3\x9f").rgba == written("Weiss").rgba).all());
  // One box, not one a byte.
  CHECK(textWidth("\xe7\x8e\x8b", 16) == textWidth("\x01", 16));
}

TEST_CASE("a polygon in a polygon is a hole, and a triangle's slanted sides are smooth") {
  Image image = blankImage(60, 60);
  fillPolygons(image, {{{10, 10}, {50, 10}, {30, 50}}, {{25, 20}, {35, 20}, {35, 25}, {25, 25}}}, kBlack);
  CHECK(ink(image) == Approx(800 - 50).epsilon(0.01));
  int grey = 0;
  for (Eigen::Index i = 0; i < image.rgba.rows(); ++i)
    grey += image.rgba(i, 0) > 20 && image.rgba(i, 0) < 235;
  CHECK(grey > 40);
}

TEST_CASE("what lies outside is cut off, and empty shapes paint nothing") {
  Image image = blankImage(20, 20);
  drawDisc(image, {-100, 5}, 20, kBlack);
  drawLine(image, {30, -5}, {1e6, 1e6}, 3, kBlack);
  drawPolyline(image, {}, 3, kBlack);
  fillPolygons(image, {}, kBlack);
  fillPolygons(image, {{{-50, -50}, {-40, -50}, {-40, 100}}}, kBlack);
  CHECK(ink(image) == 0);
  fillPolygons(image, {{{-1e5, -1e5}, {1e5, -1e5}, {1e5, 1e5}, {-1e5, 1e5}}}, kBlack);
  CHECK(ink(image) == 400);
  blit(image, blankImage(5, 5), 18, -3);
  CHECK(ink(image) == 396);
}

TEST_CASE("translucent strokes are blended once, and over clear pixels keep their colour") {
  Image image = blankImage(40, 40);
  drawPolyline(image, {{5, 20}, {35, 20}, {5, 20}, {20, 5}, {20, 35}}, 3, {0, 0, 0, 128});
  CHECK(image.pixel(20, 20)[0] == 127);
  Image clear = blankImage(9, 9, kClear);
  drawDisc(clear, {4, 4}, 2.3, {200, 10, 20, 255});
  for (Eigen::Index i = 0; i < clear.rgba.rows(); ++i)
    if (clear.rgba(i, 3) > 0) CHECK(clear.rgba(i, 0) == 200);
}

TEST_CASE("resizing keeps the mean, lets nothing bleed out of clear pixels, and magnifies as squares") {
  Image image = blankImage(37, 23);
  drawDisc(image, {18, 11}, 8, kBlack);
  for (const auto& [width, height] : {std::pair(10, 7), {74, 46}, {5, 100}, {1, 1}}) {
    const Image other = resized(image, width, height);
    CHECK(ink(other) / (width * height) == Approx(ink(image) / (37 * 23)).epsilon(0.03));
  }
  Image clear = blankImage(4, 1, kClear);
  std::uint8_t* p = clear.pixel(1, 0);
  p[0] = 250, p[3] = 255;
  CHECK(resized(clear, 1, 1).pixel(0, 0)[0] == 250);
  CHECK(resized(clear, 1, 1).pixel(0, 0)[3] == 64);
  CHECK(magnified(clear, 3).pixel(5, 2)[0] == 250);
  CHECK(magnified(clear, 3).pixel(6, 2)[0] == 0);
  CHECK(fitted(image, 20, 20).width == 20);
  CHECK(fitted(image, 20, 20).height == 12);
}

TEST_CASE("a row of a shrunk picture is the mean of the rows under it, however tall the picture") {
  Image tall(2, 1000);
  for (int y = 0; y < tall.height; ++y)
    for (int x = 0; x < 2; ++x)
      std::fill_n(tall.pixel(x, y), 4, std::uint8_t(y / 100 * 20 + (y % 2 ? 4 : 0))),
          tall.pixel(x, y)[3] = 255;
  const Image rows = resized(tall, 2, 10);
  for (int y = 0; y < 10; ++y) CHECK(std::abs(rows.pixel(1, y)[0] - (y * 20 + 2)) <= 1);
}

TEST_CASE("text has the width that is said, in all of ASCII and beyond") {
  for (int c = 33; c < 256; ++c) {
    const std::string text(3, char(c));
    Image image = blankImage(200, 60);
    drawText(image, {10, 40}, text, 24, kBlack);
    CHECK(ink(image) > 5);
    int outside = 0;
    for (int y = 0; y < 60; ++y)
      for (int x = 0; x < 200; ++x)
        if (x < 7 || x > 10 + textWidth(text, 24) + 3 || y < 13 || y > 52)
          outside += image.pixel(x, y)[0] < 255;
    CHECK(outside == 0);
  }
  CHECK(textWidth("", 10) == 0);
}

TEST_CASE("a montage holds its panels, and heat maps are brightest where the field is largest") {
  const Image red = blankImage(10, 20, {255, 0, 0}),
              sheet = montage({{red, "a"}, {red, ""}, {red, "c"}}, {.columns = 2});
  int count = 0;
  for (Eigen::Index i = 0; i < sheet.rgba.rows(); ++i)
    count += sheet.rgba(i, 0) == 255 && sheet.rgba(i, 1) == 0;
  CHECK(count == 600);
  CHECK(montage({}).width == 1);

  Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> field(1, 4);
  field << 0, 1, 2, 4;
  const Image heat = heatMap(field);
  CHECK(heat.pixel(0, 0)[3] == 0);
  const auto brightness = [&](int x) {
    return heat.pixel(x, 0)[0] + heat.pixel(x, 0)[1] + heat.pixel(x, 0)[2];
  };
  CHECK(brightness(1) < brightness(2));
  CHECK(brightness(2) < brightness(3));
}

TEST_CASE("a background is a name, a colour in figures, or neither, and a picture covers all of it") {
  CHECK(backgroundColor("none")->a == 0);
  CHECK(backgroundColor("white")->r == 255);
  CHECK(backgroundColor("#10a0ff")->g == 0xa0);
  CHECK_FALSE(backgroundColor("meadow.png"));
  for (const char* text : {"#", "#12345", "#1234567", "#12345g", "#-12345"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(backgroundColor(text), UsageError);
  }
  const Image covered = covering(blankImage(10, 40, {255, 0, 0}), 30, 20);
  CHECK((covered.width == 30 && covered.height == 20));
  CHECK(covered.rgba.col(0).minCoeff() == 255);
}

TEST_CASE("a background of 1 x 32766 px covers a film without being made as long as that is wide") {
  Image stripe = blankImage(1, 32766, {0, 0, 255});
  for (int y = 16000; y < 16766; ++y) *stripe.pixel(0, y) = 200;
  const Image covered = covering(stripe, 2048, 1024);  // whole: 2048 x 67 million
  REQUIRE((covered.width == 2048 && covered.height == 1024));
  CHECK((covered.rgba.col(0) == 200).all());
  CHECK((covered.rgba.col(3) == 255).all());
}

TEST_CASE("a picture that covers is the middle of the picture resized") {
  Image picture = blankImage(37, 11, {9, 9, 9});
  for (int y = 0; y < 11; ++y)
    for (int x = 0; x < 37; ++x) picture.pixel(x, y)[1] = std::uint8_t(x * 7 + y);
  for (const auto& [width, height] : {std::pair(20, 30), {60, 5}, {10, 11}, {5, 2}}) {
    const Image covered = covering(picture, width, height);
    const double scale = std::max(width / 37., height / 11.);
    const Image whole = resized(picture, std::max(width, int(std::lround(37 * scale))),
                                std::max(height, int(std::lround(11 * scale))));
    const int left = (whole.width - width) / 2, top = (whole.height - height) / 2;
    bool same = true;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        same =
            same && std::equal(covered.pixel(x, y), covered.pixel(x, y) + 4, whole.pixel(left + x, top + y));
    CHECK(same);
  }
}
