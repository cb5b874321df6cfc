#include "libskel/mesh/texture.h"

#include "tests/support/catch.h"

using namespace skel;

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
