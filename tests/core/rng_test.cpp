#include "libskel/core/rng.h"

#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("the generator gives PCG32's published sequence") {
  Rng rng(42, 54);
  CHECK(rng.next() == 0xa15c02b7u);
  CHECK(rng.next() == 0x7b47f409u);
  CHECK(rng.next() == 0xba1d3330u);
}

TEST_CASE("numbers are in range and spread as they should be") {
  Rng rng(1);
  double sum = 0, squares = 0;
  int counts[3] = {};
  for (int i = 0; i < 30000; ++i) {
    const double u = rng.uniform(-1, 3);
    REQUIRE((u >= -1 && u < 3));
    const double n = rng.normal();
    sum += n, squares += n * n;
    ++counts[rng.below(3)];
  }
  CHECK(sum / 30000 == Approx(0).margin(0.02));
  CHECK(squares / 30000 == Approx(1).margin(0.03));
  for (const int count : counts) CHECK(count == Approx(10000).margin(300));
}
