#include "libskel/silhouette/close_slits.h"

#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("paper that shines through a long narrow gap is the figure's, what stands apart stays so") {
  Plane8 figure = Plane8::Zero(400, 300);
  figure.block(0, 50, 200, 200) = 255;   // a trunk
  figure.block(200, 50, 200, 80) = 255;  // legs, 20 px apart
  figure.block(200, 150, 200, 80) = 255;
  const Plane8 whole = figure;
  figure.block(60, 50, 2, 120) = 0;  // below a sleeve
  for (int k = 0; k < 90; ++k) figure.block(100 + k, 200 - k / 2, 1, 3) = 0;
  closeSlits(figure);
  CHECK((figure != whole).count() < 12);  // of 510: their mouths
}

TEST_CASE("corners and short notches of a figure are no slits") {
  Plane8 figure = Plane8::Zero(400, 300);
  for (int step = 0; step < 40; ++step) figure.block(10 * step, 0, 10, 300 - 6 * step) = 255;  // stairs
  figure.block(50, 0, 2, 6) = 0;
  const Plane8 before = figure;
  closeSlits(figure);
  CHECK((figure == before).all());
}
