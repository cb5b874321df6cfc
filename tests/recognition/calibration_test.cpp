#include "libskel/recognition/calibration.h"

#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("the area under the ROC curve counts pairs in the right order, ties half") {
  CHECK(areaUnderRoc({{.9, true}, {.8, true}, {.3, false}}) == 1);
  CHECK(areaUnderRoc({{.2, true}, {.8, false}}) == 0);
  CHECK(areaUnderRoc({{.5, true}, {.5, false}}) == .5);
  CHECK(areaUnderRoc({{.9, true}, {.6, false}, {.4, true}, {.1, false}}) == .75);
  CHECK(areaUnderRoc({{.9, true}, {.8, true}}) == .5);
  CHECK(areaUnderRoc({}) == .5);
}

TEST_CASE("the calibration error is how far bins of what was said lie from what came out") {
  CHECK(calibrationError({}) == 0);
  CHECK(calibrationError({{1, true}, {0, false}}) == 0);
  CHECK(calibrationError({{.75, true}, {.75, true}, {.75, true}, {.75, false}}) == 0);
  CHECK(calibrationError({{.95, false}, {.05, true}}) == Approx(.95));
  // One bin of two forecasts off by .2 each, one of two that is right.
  CHECK(calibrationError({{.8, true}, {.8, true}, {.5, true}, {.5, false}}) == Approx(.1));
}
