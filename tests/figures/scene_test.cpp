#include "trainer/figures/scene.h"

#include <cmath>
#include <numbers>

#include "tests/support/catch.h"

namespace skel {
namespace {

using Vec = Eigen::Vector2d;

int solidPixels(const Raster& raster) {
  int n = 0;
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) n += raster.solid(x, y);
  }
  return n;
}

TEST_CASE("A rectangle covers exactly the pixels whose centres it holds") {
  Scene scene;
  scene.begin({});
  scene.polygon({Vec(2, 3), Vec(7, 3), Vec(7, 5), Vec(2, 5)});
  const Raster raster = rasterize(scene, Vec(0, 0), 1, 10, 10);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 10; ++x) {
      INFO(x << " " << y);
      CHECK(raster.solid(x, y) == (x >= 2 && x < 7 && y >= 3 && y < 5));
    }
  }
}

TEST_CASE("A disc and a capsule have their areas") {
  Scene scene;
  scene.begin({});
  scene.disc(Vec(50, 50), 30);
  CHECK(solidPixels(rasterize(scene, Vec(0, 0), 1, 100, 100)) == Approx(std::numbers::pi * 900).epsilon(.04));
  Scene capsule;
  capsule.begin({});
  capsule.line(Vec(20, 50), Vec(80, 50), 10, 10);
  CHECK(solidPixels(rasterize(capsule, Vec(0, 0), 1, 100, 100)) ==
        Approx(60 * 20 + std::numbers::pi * 100).epsilon(.03));
}

TEST_CASE("Parts in front hide those behind, and their rims part them") {
  Ink red, blue;
  red.fill = {255, 0, 0};
  blue.fill = {0, 0, 255};
  blue.rim = {0, 0, 0};
  blue.rim_width = 2;
  Scene scene;
  scene.begin(red, PartOwner::kTorso);
  scene.ellipse(Vec(20, 20), {18, 18}, 0);
  scene.begin(blue, PartOwner::kLeftArm);
  scene.disc(Vec(20, 20), 5);
  const Raster raster = rasterize(scene, Vec(0, 0), 1, 40, 40);
  CHECK(raster.colour(20, 20) == Colour{0, 0, 255});
  CHECK(raster.colour(20, 26) == Colour{0, 0, 0});
  CHECK(raster.colour(20, 32) == Colour{255, 0, 0});
  CHECK(raster.owner(20, 20) == PartOwner::kLeftArm);
  CHECK(raster.owner(20, 32) == PartOwner::kTorso);
}

TEST_CASE("A hollow part is a ring") {
  Ink ink;
  ink.hollow = true;
  ink.rim_width = 3;
  Scene scene;
  scene.begin(ink);
  scene.disc(Vec(20, 20), 10);
  const Raster raster = rasterize(scene, Vec(0, 0), 1, 40, 40);
  CHECK_FALSE(raster.solid(20, 20));
  CHECK(raster.solid(31, 20));
}

TEST_CASE("Details appear only where there is figure, and do not widen its box") {
  Ink detail;
  detail.inside_only = true;
  Scene scene;
  scene.begin({});
  scene.disc(Vec(20, 20), 10);
  scene.begin(detail);
  scene.disc(Vec(32, 20), 8);
  const Raster raster = rasterize(scene, Vec(0, 0), 1, 50, 40);
  CHECK_FALSE(raster.solid(35, 20));
  CHECK(raster.part[20 * 50 + 28] == 2);
  CHECK(scene.box().high.x() == Approx(30));
}

TEST_CASE("What lies outside the raster is cut off") {
  Scene scene;
  scene.begin({});
  scene.disc(Vec(-5, 5), 8);
  scene.disc(Vec(500, 500), 8);
  CHECK(rasterize(scene, Vec(0, 0), 1, 10, 10).solid(0, 5));
}

}  // namespace
}  // namespace skel
