// Lines about what a piece of a figure had hidden by another.
#include "libskel/mesh/hidden_ink.h"

#include <algorithm>
#include <cmath>

#include "libskel/mesh/outline.h"
#include "libskel/silhouette/outline.h"
#include "tests/support/catch.h"

using namespace skel;

namespace {

// A red disc in a line 6 px wide; an arm hid what lies right of x = 120, and left some of its own line beside
// that.
struct HalfHidden {
  static constexpr int kSize = 200, kRadius = 80, kLine = 6, kFrom = 120;
  Image image{kSize, kSize};
  Plane8 mask = Plane8::Zero(kSize, kSize), hidden = mask;

  explicit HalfHidden(bool outlined = true) {
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const double from_middle = std::hypot(x - 100, y - 100);
        if (from_middle > kRadius) continue;
        mask(y, x) = 255;
        hidden(y, x) = x >= kFrom;
        paint(x, y, outlined && x < kFrom && from_middle > kRadius - kLine);
      }
  }
  void paint(int x, int y, bool ink) {
    std::uint8_t* p = image.pixel(x, y);
    p[0] = ink ? 20 : 220, p[1] = ink ? 20 : 60, p[2] = ink ? 20 : 50, p[3] = 255;
  }
  bool isInk(int x, int y) const { return image.pixel(x, y)[0] < 60; }
  Image inked() const {
    Image result = image;
    std::vector<std::vector<Eigen::Vector2d>> outline;
    for (const Polygon& corners : traceOutline(mask)) outline.push_back(sideMiddles(corners));
    inkHiddenRim(mask, hidden, outline, result);
    return result;
  }
};

}  // namespace

TEST_CASE("lines beside what was hidden are not known, others and broad dark areas far from it are") {
  HalfHidden disc;
  for (int y = 80; y < 120; ++y) {
    for (int x = 116; x < 120; ++x) disc.paint(x, y, true);  // of the arm's line
    for (int x = 60; x < 64; ++x) disc.paint(x, y, true);    // of the shirt's
  }
  const Plane8 unknown = withLeftInk(disc.image, disc.mask, disc.hidden, 6);
  for (int x = 116; x < 120; ++x) CHECK(unknown(100, x) != 0);
  CHECK(unknown(100, 115) == 0);
  CHECK(unknown(100, 62) == 0);
  CHECK(unknown(70, 117) == 0);
  CHECK(((disc.hidden == 0) || (unknown != 0)).all());
  // No farther than it is told.
  CHECK(withLeftInk(disc.image, disc.mask, disc.hidden, 2)(100, 116) == 0);
}

TEST_CASE("a hidden rim wears the outline that is drawn along the rest, as wide, and nothing else changes") {
  const HalfHidden disc;
  const Image inked = disc.inked();
  const auto dark = [&](int x, int y) { return inked.pixel(x, y)[0] < 60; };
  int wide = 0;
  for (int x = 150; x <= 180; ++x) wide += dark(x, 100);
  CHECK(wide >= HalfHidden::kLine - 2);
  CHECK(wide <= HalfHidden::kLine + 2);
  CHECK(dark(178, 100));
  CHECK_FALSE(dark(168, 100));
  for (int y = 0; y < HalfHidden::kSize; ++y)
    for (int x = 0; x < HalfHidden::kFrom; ++x) REQUIRE(dark(x, y) == disc.isInk(x, y));
}

TEST_CASE("a figure without an outline gets none where it was hidden") {
  const HalfHidden disc(false);
  CHECK((disc.inked().rgba == disc.image.rgba).all());
}
