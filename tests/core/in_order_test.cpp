#include "libskel/core/in_order.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("pieces are taken in order, each once, with any number of threads, in few slots") {
  for (const int threads : {0, 1, 2, 8})
    for (const std::size_t count : {0u, 1u, 3u, 1000u}) {
      std::vector<std::size_t> slots(slotsInOrder(threads)), taken;
      std::atomic<std::size_t> begun{0}, most_at_work{0}, at_work{0};
      parallelInOrder(threads, {.next =
                                    [&](std::size_t slot) {
                                      if (begun == count) return false;
                                      slots.at(slot) = begun++;
                                      return true;
                                    },
                                .work =
                                    [&](std::size_t slot) {
                                      const std::size_t now = ++at_work;
                                      if (now > most_at_work) most_at_work = now;
                                      slots.at(slot) *= 2;
                                      if (slots.at(slot) % 7 == 0) std::this_thread::yield();
                                      --at_work;
                                    },
                                .take = [&](std::size_t slot) { taken.push_back(slots.at(slot)); }});
      REQUIRE(taken.size() == count);
      for (std::size_t i = 0; i < count; ++i) CHECK(taken[i] == 2 * i);
      if (threads > 0) CHECK(most_at_work <= std::size_t(threads));
    }
}

TEST_CASE("a slow piece is waited for, and those behind it do not pile up") {
  std::atomic<std::size_t> begun{0}, most_ahead{0};
  std::size_t taken = 0;
  parallelInOrder(4, {.next =
                          [&](std::size_t) {
                            most_ahead = std::max<std::size_t>(most_ahead, begun);
                            return ++begun <= 1000;
                          },
                      .work =
                          [&](std::size_t slot) {
                            if (slot == 0 && begun < 200)
                              std::this_thread::sleep_for(std::chrono::milliseconds(50));
                          },
                      .take =
                          [&](std::size_t) {
                            if (taken++ == 0) CHECK(most_ahead < slotsInOrder(4));
                          }});
  CHECK(taken == 1000);
}

TEST_CASE("what is done is handed on while the next piece is waited for") {
  std::atomic<int> taken{0};
  int begun = 0;
  bool in_time = true;
  parallelInOrder(2, {.next =
                          [&](std::size_t) {
                            // The second comes when the first has been taken.
                            for (int ms = 0; begun == 1 && taken == 0 && ms < 5000; ++ms)
                              std::this_thread::sleep_for(std::chrono::milliseconds(1));
                            if (begun == 1) in_time = taken == 1;
                            return ++begun <= 2;
                          },
                      .work = [](std::size_t) {},
                      .take = [&](std::size_t) { ++taken; }});
  CHECK(in_time);
  CHECK(taken == 2);
}

TEST_CASE("a failure of any step ends the run and is told") {
  for (const std::string where : {"next", "work", "take"}) {
    int begun = 0;
    std::atomic<int> taken{0};
    const auto fail = [&](const char* step, bool when) {
      if (where == step && when) throw std::runtime_error(step);
    };
    CHECK_THROWS_WITH(parallelInOrder(3, {.next =
                                              [&](std::size_t) {
                                                fail("next", begun == 5);
                                                return ++begun <= 100000;
                                              },
                                          .work = [&](std::size_t slot) { fail("work", slot == 5); },
                                          .take =
                                              [&](std::size_t slot) {
                                                fail("take", slot == 5);
                                                ++taken;
                                              }}),
                      where);
    CHECK(taken <= 5);
    CHECK(begun < 100000);
  }
}
