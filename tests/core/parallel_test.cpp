#include "libskel/core/parallel.h"

#include <atomic>
#include <stdexcept>
#include <vector>

#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("each piece is done once, with any number of threads") {
  for (const int threads : {0, 1, 2, 8})
    for (const std::size_t count : {0u, 1u, 3u, 100u}) {
      std::vector<std::atomic<int>> done(count);
      parallelFor(count, threads, [&](std::size_t i) { ++done[i]; });
      for (const auto& times : done) CHECK(times == 1);
    }
}

TEST_CASE("the failure of the smallest piece is told, after all have run") {
  std::atomic<int> done{0};
  const auto work = [&](std::size_t i) {
    ++done;
    if (i % 2 == 1) throw std::runtime_error(std::to_string(i));
  };
  CHECK_THROWS_WITH(parallelFor(20, 4, work), "1");
  CHECK(done == 20);
}
