#include "libskel/silhouette/silhouette.h"

#include "libskel/core/rng.h"
#include "libskel/image/read_image.h"
#include "tests/support/catch.h"

using namespace skel;

namespace {

Plane8 disc(int size, double x, double y, double radius) {
  Plane8 mask = Plane8::Zero(size, size);
  for (int row = 0; row < size; ++row) {
    for (int col = 0; col < size; ++col) {
      if ((col - x) * (col - x) + (row - y) * (row - y) <= radius * radius) mask(row, col) = 255;
    }
  }
  return mask;
}

}  // namespace

TEST_CASE("a disc comes back as it is") {
  const Plane8 mask = disc(100, 50, 50, 30);
  const Silhouette s = silhouetteFromMask(mask);
  REQUIRE(s.found());
  CHECK((s.mask == mask).all());
  CHECK(s.figure_count == 1);
  CHECK(s.warnings.empty());
  CHECK(s.outline.size() == 1);
  CHECK(s.grid.width == 128);
  CHECK(s.grid.height == 128);
}
