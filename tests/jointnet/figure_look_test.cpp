#include "libskel/jointnet/figure_look.h"

#include "tests/support/catch.h"

namespace skel {
namespace {

TEST_CASE("A line inside the figure is strong, the figure's outline and the paper are not") {
  Plane8 mask = Plane8::Zero(20, 20);
  mask.block(4, 4, 12, 12) = 255;
  GridColours colours = GridColours::Constant(400, 3, 255.f);
  for (int y = 4; y < 16; ++y) {
    for (int x = 4; x < 16; ++x) colours.row(y * 20 + x) = y == 10 ? 30.f : 200.f;
  }
  const Plane8 lines = lineStrength(colours, mask);
  CHECK(lines(10, 8) == 255);
  CHECK(lines(9, 8) == 255);
  CHECK(lines(6, 8) == 0);
  CHECK(lines(4, 8) == 0);
  CHECK(lines(0, 0) == 0);
}

TEST_CASE("Pale and strong ink give the same lines, paper grain gives hardly any") {
  Plane8 mask = Plane8::Constant(16, 16, 255);
  GridColours strong = GridColours::Constant(256, 3, 220.f), grain = strong;
  for (int x = 0; x < 16; ++x) strong.row(8 * 16 + x) = 20.f;
  const GridColours pale = 170 + (strong - 170) * .3f;
  CHECK((lineStrength(strong, mask) == lineStrength(pale, mask)).all());
  for (int i = 0; i < 256; ++i) grain.row(i) += static_cast<float>(i % 3);
  CHECK(lineStrength(grain, mask).maxCoeff() < 60);
}

TEST_CASE("No figure, no lines") {
  CHECK((lineStrength(GridColours::Zero(6, 3), Plane8::Zero(2, 3)) == 0).all());
}

TEST_CASE("Grid colours are means over the picture's pixels, over white") {
  Image image(8, 8);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      std::uint8_t* p = image.pixel(x, y);
      p[0] = static_cast<std::uint8_t>(x < 4 ? 100 : 200);
      p[1] = 0;
      p[2] = 0;
      p[3] = y < 4 ? 255 : 0;
    }
  }
  const GridColours c = gridColours(image, {0, 0}, .25, 2, 2);
  CHECK(c(0, 0) == Approx(100));
  CHECK(c(1, 0) == Approx(200));
  CHECK(c(1, 1) == Approx(0));
  CHECK(c(2, 0) == Approx(255));
  CHECK(c(3, 1) == Approx(255));
  // A grid finer than the picture.
  CHECK(gridColours(image, {0, 0}, 2, 16, 16)(2, 0) == Approx(100));
}

}  // namespace
}  // namespace skel
