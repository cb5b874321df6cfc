#include "libskel/figures/figure.h"

#include <set>

#include "tests/support/catch.h"

namespace skel {
namespace {

constexpr int kFigures = 300, kJoints = 14;

bool sameFigure(const Figure& a, const Figure& b) {
  return a.mask.rows() == b.mask.rows() && a.mask.cols() == b.mask.cols() && (a.mask == b.mask).all() &&
         (a.look.lines == b.look.lines).all() && (a.look.tones[0] == b.look.tones[0]).all() &&
         a.joints == b.joints && a.visible == b.visible;
}

TEST_CASE("A seed gives the same figure, another seed another") {
  Rng a(7), b(7), c(8);
  const Figure first = generateFigure(a), again = generateFigure(b), other = generateFigure(c);
  CHECK(sameFigure(first, again));
  CHECK_FALSE(sameFigure(first, other));
}

TEST_CASE("A figure is one part that fills its grid") {
  Rng rng(1);
  FigureOptions options;
  options.other_share = .3;
  for (int i = 0; i < kFigures; ++i) {
    INFO("figure " << i);
    const Figure f = generateFigure(rng, options);
    CHECK(std::max(f.mask.rows(), f.mask.cols()) == 128);
    REQUIRE((f.mask == 0 || f.mask == 255).all());
    CHECK((f.look.lines == 0 || f.mask == 255).all());
    // Flood from any pixel of the figure.
    Plane8 left = f.mask;
    std::vector<std::pair<int, int>> stack;
    int parts = 0;
    for (int y = 0; y < left.rows(); ++y) {
      for (int x = 0; x < left.cols(); ++x) {
        if (left(y, x) == 0) continue;
        ++parts;
        stack.emplace_back(y, x);
        while (!stack.empty()) {
          const auto [v, u] = stack.back();
          stack.pop_back();
          if (v < 0 || u < 0 || v >= left.rows() || u >= left.cols() || left(v, u) == 0) continue;
          left(v, u) = 0;
          for (const auto& [dy, dx] : {std::pair(0, 1), {0, -1}, {1, 0}, {-1, 0}})
            stack.emplace_back(v + dy, u + dx);
        }
      }
    }
    CHECK(parts == 1);
  }
}

TEST_CASE("Joints lie at the figure, hands and feet in it") {
  Rng rng(2);
  int inside = 0, visible = 0;
  for (int i = 0; i < kFigures; ++i) {
    const Figure f = generateFigure(rng);
    REQUIRE(f.whole);
    for (int j = 0; j < kJoints; ++j) {
      const int x = static_cast<int>(std::lround(f.joints[j].x())),
                y = static_cast<int>(std::lround(f.joints[j].y()));
      inside += x >= 0 && y >= 0 && x < f.mask.cols() && y < f.mask.rows() && f.mask(y, x) != 0;
      visible += f.visible[j];
    }
  }
  // The rest are holes of figures that are mere outlines, and ends that the finish has shortened.
  CHECK(inside > .93 * kFigures * kJoints);
  CHECK(visible > .6 * kFigures * kJoints);
}

TEST_CASE("In side views the limb at the left of the picture is the right one") {
  Rng rng(3);
  int seen = 0;
  for (int i = 0; i < kFigures; ++i) {
    const Figure f = generateFigure(rng);
    if (f.view != FigureView::kSide) continue;
    ++seen;
    for (const int first : {2, 5}) {
      double left = 0, right = 0;
      for (int k = first; k < first + 3; ++k) left += f.joints[k].x(), right += f.joints[k + 6].x();
      CHECK(right <= left);
    }
  }
  CHECK(seen > kFigures / 12);
}

TEST_CASE("Kinds can be chosen, and come all if not") {
  Rng rng(4);
  FigureOptions options;
  options.kinds = {3, 5};
  std::set<int> chosen, all;
  for (int i = 0; i < 40; ++i) chosen.insert(generateFigure(rng, options).kind);
  for (int i = 0; i < kFigures; ++i) all.insert(generateFigure(rng).kind);
  CHECK(chosen == std::set<int>{3, 5});
  CHECK(all.size() == figurePlan("biped").kinds.size());
}

TEST_CASE("Others are marked as not whole") {
  Rng rng(5);
  FigureOptions options;
  options.other_share = 1;
  for (int i = 0; i < 50; ++i) CHECK_FALSE(generateFigure(rng, options).whole);
}

}  // namespace
}  // namespace skel
