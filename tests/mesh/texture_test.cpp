#include "libskel/mesh/texture.h"

#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("a texture smaller than its figure reads no pixel beyond it: models had other bytes at each run") {
  for (int max_size = 12; max_size < 120; max_size += 3)
    for (int side = max_size - 8; side < 400; ++side) {
      CAPTURE(max_size, side);
      const Image image(side, 3);
      const DrawingTexture texture =
          drawingTexture(image, Plane8::Constant(3, side, 255), {0, 0, side, 3}, max_size);
      CHECK(texture.image.width <= max_size);
      const auto column = texture.figure.col(texture.image.width - 1 - kTextureMargin);
      CHECK((column != 0).any());
    }
}

TEST_CASE("a texel over tens of thousands of pixels has their colour") {
  Image image(200, 200);
  image.rgba.setConstant(255);
  image.rgba.col(2).setConstant(100);
  const DrawingTexture texture = drawingTexture(image, Plane8::Constant(200, 200, 255), {0, 0, 200, 200}, 9);
  for (Eigen::Index i = 0; i < texture.image.rgba.rows(); ++i) {
    CHECK(texture.image.rgba(i, 0) == 255);
    CHECK(texture.image.rgba(i, 2) == 100);
  }
}
