#include "libskel/core/undo_history.h"

#include <utility>

#include "tests/support/catch.h"

using namespace skel;

namespace {

// A number that steps set: each keeps what was there before, and on the way back what was there after.
struct Counter {
  int value = 0;
  UndoHistory<int> history{3};

  void set(int to) { history.push(std::exchange(value, to)); }
  bool undo() {
    return history.undo([&](int& other) { return std::swap(value, other), true; });
  }
  bool redo() {
    return history.redo([&](int& other) { return std::swap(value, other), true; });
  }
};

}  // namespace

TEST_CASE("steps are undone to the start and done again to the end") {
  Counter counter;
  CHECK_FALSE(counter.undo());
  CHECK_FALSE(counter.redo());
  counter.set(1), counter.set(2);
  CHECK(counter.undo());
  CHECK(counter.value == 1);
  CHECK(counter.undo());
  CHECK(counter.value == 0);
  CHECK_FALSE(counter.history.canUndo());
  CHECK(counter.redo());
  CHECK(counter.redo());
  CHECK(counter.value == 2);
  CHECK_FALSE(counter.history.canRedo());
}

TEST_CASE("after a new step what was undone cannot be done again, and the oldest steps are forgotten") {
  Counter counter;
  for (int i = 1; i <= 5; ++i) counter.set(i);
  CHECK(counter.undo());
  counter.set(9);
  CHECK_FALSE(counter.redo());
  while (counter.undo()) {
  }
  CHECK(counter.value == 2);
}

TEST_CASE("a step that cannot be travelled stays where it is") {
  Counter counter;
  counter.set(1);
  CHECK_FALSE(counter.history.undo([](int&) { return false; }));
  CHECK(counter.history.canUndo());
  CHECK_FALSE(counter.history.canRedo());
  CHECK(counter.undo());
}
