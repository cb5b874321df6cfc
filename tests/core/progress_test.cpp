// What is said of work that takes long.
#include "libskel/core/progress.h"

#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("a line of progress says how far it is, and how long it still takes") {
  CHECK(progressLine("rigging", 12, 24, 70, "") == "rigging: 12 of 24, 1:10 left");
  CHECK(progressLine("training", 100, 3000, 60, "loss 0.31") ==
        "training: 100 of 3000, 29:00 left, loss 0.31");
  CHECK(progressLine("training", 1, 40, 120, "") == "training: 1 of 40");
  CHECK(progressLine("rigging", 24, 24, 70, "") == "rigging: 24 of 24, 0:00 left");
}

TEST_CASE("of work whose end nobody knows it is said how far it has come") {
  CHECK(progressLine("rigging", 12, 0, 70, "") == "rigging: 12 in 1:10");
}

TEST_CASE("a log gets a line every few seconds at first, and one a minute of what takes hours") {
  CHECK(pauseBetweenLines_s(0) == 5);
  CHECK(pauseBetweenLines_s(100) == 10);
  CHECK(pauseBetweenLines_s(7200) == 60);
}
