#include "trainer/figures/figure.h"

#include <set>

#include "libskel/jointnet/net_joints.h"
#include "tests/support/catch.h"

namespace skel {
namespace {

constexpr int kFigures = 300;

// The name of each body plan in turn.
std::string anyPlan() {
  return std::string(GENERATE(from_range(figurePlans().begin(), figurePlans().end())).body_plan);
}

bool sameFigure(const Figure& a, const Figure& b) {
  return a.mask.rows() == b.mask.rows() && a.mask.cols() == b.mask.cols() && (a.mask == b.mask).all() &&
         (a.look.lines == b.look.lines).all() && (a.look.tones[0] == b.look.tones[0]).all() &&
         a.joints == b.joints && a.visible == b.visible;
}

TEST_CASE("A seed gives the same figure, another seed another") {
  FigureOptions options;
  options.body_plan = anyPlan();
  Rng a(7), b(7), c(8);
  const Figure first = generateFigure(a, options), again = generateFigure(b, options),
               other = generateFigure(c, options);
  CHECK(sameFigure(first, again));
  CHECK_FALSE(sameFigure(first, other));
}

TEST_CASE("A figure is one part that fills its grid") {
  Rng rng(1);
  FigureOptions options;
  options.body_plan = anyPlan();
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
  FigureOptions options;
  options.body_plan = anyPlan();
  const std::size_t joints = figurePlan(options.body_plan).joints.size();
  Rng rng(2);
  int inside = 0, visible = 0;
  for (int i = 0; i < kFigures; ++i) {
    const Figure f = generateFigure(rng, options);
    REQUIRE(f.whole);
    REQUIRE(f.joints.size() == joints);
    for (std::size_t j = 0; j < joints; ++j) {
      const int x = static_cast<int>(std::lround(f.joints[j].x())),
                y = static_cast<int>(std::lround(f.joints[j].y()));
      inside += x >= 0 && y >= 0 && x < f.mask.cols() && y < f.mask.rows() && f.mask(y, x) != 0;
      visible += f.visible[j];
    }
  }
  // The rest are holes of figures that are mere outlines, and ends that the finish has shortened.
  INFO(options.body_plan);
  CHECK(inside > .93 * static_cast<double>(kFigures * joints));
  CHECK(visible > .6 * static_cast<double>(kFigures * joints));
}

TEST_CASE("In side views the limb at the left of the picture is the right one") {
  FigureOptions options;
  options.body_plan = anyPlan();
  const NetJoints joints =
      netJoints(jointNames(figurePlan(options.body_plan)), loadTemplate(options.body_plan));
  REQUIRE(joints.limbs.size() == 2);
  Rng rng(3);
  int seen = 0;
  for (int i = 0; i < kFigures; ++i) {
    const Figure f = generateFigure(rng, options);
    if (f.view != FigureView::kSide) continue;
    ++seen;
    for (const std::vector<int>& limb : joints.limbs) {
      double left = 0, right = 0;
      for (const int k : limb) left += f.joints[k].x(), right += f.joints[joints.mirrored[k]].x();
      CHECK(right <= left);
    }
  }
  CHECK(seen > kFigures / 12);
}

TEST_CASE("Kinds can be chosen, and come all if not") {
  Rng rng(4);
  FigureOptions options;
  options.body_plan = anyPlan();
  options.kinds = {3, 5};
  std::set<int> chosen, all;
  for (int i = 0; i < 40; ++i) chosen.insert(generateFigure(rng, options).kind);
  options.kinds.clear();
  for (int i = 0; i < kFigures; ++i) all.insert(generateFigure(rng, options).kind);
  CHECK(chosen == std::set<int>{3, 5});
  CHECK(all.size() == figurePlan(options.body_plan).kinds.size());
}

TEST_CASE("Others are marked as not whole") {
  Rng rng(5);
  FigureOptions options;
  options.body_plan = anyPlan();
  options.other_share = 1;
  for (int i = 0; i < 50; ++i) CHECK_FALSE(generateFigure(rng, options).whole);
}

TEST_CASE("Figures of an unknown body plan are refused") {
  CHECK_THROWS_WITH(
      figurePlan("centaur"),
      "no figures can be drawn of the template \"centaur\"; there are figures of: biped, quadruped");
}

}  // namespace
}  // namespace skel
