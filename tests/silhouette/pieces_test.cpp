#include "libskel/silhouette/pieces.h"

#include "libskel/silhouette/silhouette.h"
#include "tests/support/catch.h"

namespace skel {
namespace {

// 255 in a disc.
void addDisc(Plane8& mask, double cx, double cy, double radius) {
  for (Eigen::Index y = 0; y < mask.rows(); ++y)
    for (Eigen::Index x = 0; x < mask.cols(); ++x)
      if (std::hypot(static_cast<double>(x) - cx, static_cast<double>(y) - cy) <= radius) mask(y, x) = 255;
}

// A trunk on two legs, 60 to 280 px from the top.
Plane8 headless() {
  Plane8 mask = Plane8::Zero(300, 300);
  mask.block(70, 130, 110, 40) = 255;
  mask.block(180, 132, 100, 14) = 255;
  mask.block(180, 154, 100, 14) = 255;
  return mask;
}

// Of figures in a picture of 300×300 px.
Plane8 maskOf(const JoinedFigure& figure) { return figure.inPicture(figure.mask, 300, 300); }
Plane8 bridgesOf(const JoinedFigure& figure) { return figure.inPicture(figure.bridges, 300, 300); }

TEST_CASE("a head that floats above the neck belongs to the figure") {
  Plane8 mask = headless();
  addDisc(mask, 150, 40, 22);
  const auto figures = joinPieces(mask, 8);
  REQUIRE(figures.size() == 1);
  CHECK(figures[0].pieces == 2);
  CHECK(((mask != 0) <= (maskOf(figures[0]) != 0)).all());
  // The gap between them is bridged, and known to be none of what was drawn.
  CHECK(maskOf(figures[0])(66, 150) == 255);
  CHECK(bridgesOf(figures[0])(66, 150) == 255);
  CHECK(((bridgesOf(figures[0]) != 0) && (mask != 0)).count() == 0);
  // What comes of it is one 4-connected figure.
  const Silhouette s = silhouetteFromMask(mask);
  CHECK(s.figure_count == 1);
  CHECK(s.outline.size() == 1);
  CHECK(s.bridges.size() == s.mask.size());
}

TEST_CASE("hands like balls and a limb in two halves are joined, each to what is nearest") {
  Plane8 mask = headless();
  addDisc(mask, 150, 40, 30);
  mask.block(90, 178, 10, 40) = 255;
  addDisc(mask, 230, 95, 8);
  const auto figures = joinPieces(mask, 8);
  REQUIRE(figures.size() == 1);
  CHECK(figures[0].pieces == 3);
  CHECK(maskOf(figures[0])(95, 230) == 255);
  CHECK(bridgesOf(figures[0])(95, 220) == 255);
}

TEST_CASE("a neighbour, a speck, a far ball and a shadow are no pieces of the figure") {
  Plane8 mask = headless();
  addDisc(mask, 150, 40, 28);
  const Plane8 alone = maskOf(joinPieces(mask, 8).front());
  SECTION("a neighbour as tall") {
    mask.block(30, 220, 250, 50) = 255;
    CHECK(joinPieces(mask, 8).size() == 2);
    return;
  }
  SECTION("a speck") { mask(60, 200) = 255; }
  SECTION("a ball far off") { addDisc(mask, 270, 270, 12); }
  SECTION("a shadow under the feet") { mask.block(284, 100, 8, 100) = 255; }
  const auto figures = joinPieces(mask, 8);
  REQUIRE(figures.size() == 1);
  CHECK((maskOf(figures[0]) == alone).all());
}

TEST_CASE("without anything drawn there are no figures") {
  CHECK(joinPieces(Plane8::Zero(20, 30), 8).empty());
  CHECK(joinPieces(Plane8::Zero(1, 1), 8).empty());
}

}  // namespace
}  // namespace skel
