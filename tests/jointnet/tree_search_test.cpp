#include "libskel/jointnet/tree_search.h"

#include "libskel/skeleton/template.h"
#include "tests/support/catch.h"

namespace skel {
namespace {

constexpr int cellAt(int x, int y) { return y * kHeatmapSize + x; }

Heatmap peak(int cell) {
  Heatmap map{};
  map[static_cast<std::size_t>(cell)] = 1;
  return map;
}

// Body, shoulder, elbow and hand of the left arm, and the same of the right one far from it.
struct Arms {
  NetJoints joints = netJoints(
      {"body", "left_shoulder", "left_elbow", "left_hand", "right_shoulder", "right_elbow", "right_hand"},
      loadTemplate("biped"));
  std::vector<Heatmap> maps = {peak(cellAt(18, 18)), peak(cellAt(20, 14)), peak(cellAt(24, 14)),
                               peak(cellAt(28, 14)), peak(cellAt(16, 14)), peak(cellAt(12, 14)),
                               peak(cellAt(8, 14))};
  std::vector<BoneLength> bones;

  std::vector<int> found() const {
    const Plane8 mask = Plane8::Constant(kFrameSize, kFrameSize, 255);
    return searchTree(mask, Eigen::Vector2d::Zero(), maps, joints, bones);
  }
};

TEST_CASE("A joint is where its heatmap is highest, if nothing speaks against it") {
  const Arms arms;
  CHECK(arms.found() == std::vector<int>{cellAt(18, 18), cellAt(20, 14), cellAt(24, 14), cellAt(28, 14),
                                         cellAt(16, 14), cellAt(12, 14), cellAt(8, 14)});
}

TEST_CASE("A bone of a common length beats one that is far too short, where the heatmap doubts") {
  Arms arms;
  arms.maps[2] = {};
  arms.maps[2][cellAt(21, 14)] = .6f;
  arms.maps[2][cellAt(24, 14)] = .4f;
  CHECK(arms.found()[2] == cellAt(21, 14));
  arms.bones.resize(7);
  arms.bones[2] = {BoneLength::logOf(16), .2, 0, 0};
  CHECK(arms.found()[2] == cellAt(24, 14));
  // A heatmap that is sure is believed.
  arms.maps[2][cellAt(21, 14)] = .999f;
  arms.maps[2][cellAt(24, 14)] = .001f;
  CHECK(arms.found()[2] == cellAt(21, 14));
}

TEST_CASE("Elbow and hand are chosen together, so that both bones of an arm are in proportion") {
  Arms arms;
  // By itself the hand is rather at the far place and the elbow at the near one.
  arms.maps[2] = arms.maps[3] = {};
  arms.maps[2][cellAt(22, 14)] = .52f;
  arms.maps[2][cellAt(25, 14)] = .48f;
  arms.maps[3][cellAt(30, 14)] = .55f;
  arms.maps[3][cellAt(24, 14)] = .45f;
  CHECK(arms.found()[2] == cellAt(22, 14));
  CHECK(arms.found()[3] == cellAt(30, 14));
  arms.bones.resize(7);
  arms.bones[3] = {BoneLength::logOf(16), 10, 0, .1};
  const std::vector<int> found = arms.found();
  CHECK(found[2] == cellAt(25, 14));
  CHECK(found[3] == cellAt(30, 14));
}

TEST_CASE("A bone outside the figure costs") {
  Arms arms;
  arms.maps[3] = {};
  arms.maps[3][cellAt(28, 14)] = .6f;
  arms.maps[3][cellAt(24, 18)] = .4f;
  Plane8 mask = Plane8::Constant(kFrameSize, kFrameSize, 255);
  mask.rightCols(kFrameSize - 102) = 0;
  CHECK(arms.found()[3] == cellAt(28, 14));
  CHECK(searchTree(mask, Eigen::Vector2d::Zero(), arms.maps, arms.joints, {})[3] == cellAt(24, 18));
}

}  // namespace
}  // namespace skel
