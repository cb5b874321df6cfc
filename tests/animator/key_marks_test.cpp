#include "animator/key_marks.h"

#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("keys that stand apart are marked one by one, a key on every frame is one stretch") {
  CHECK(keyMarks({}, 0.1).empty());
  CHECK(keyMarks({0, 0.5, 1}, 0.1) == std::vector<KeyMark>{{0, 0}, {0.5, 0.5}, {1, 1}});
  std::vector<double> frames;
  for (int i = 0; i <= 30; ++i) frames.push_back(i / 30.0);
  CHECK(keyMarks(frames, 0.05) == std::vector<KeyMark>{{0, 1}});
  CHECK(keyMarks({0, 0.04, 0.08, 0.5, 0.9, 0.93}, 0.05) ==
        std::vector<KeyMark>{{0, 0.08}, {0.5, 0.5}, {0.9, 0.93}});
  CHECK(keyMarks({0.5}, 0.05).front().isOne());
}
