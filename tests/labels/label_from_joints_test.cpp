#include "libskel/labels/label_from_joints.h"

#include <set>

#include "tests/support/catch.h"

using namespace skel;

namespace {

// A figure that fills its box, so that only the joints decide. Grid = image.
CandidateSet candidatesAt(const std::vector<JointCandidate>& maxima) {
  CandidateSet candidates;
  candidates.distance = DistanceField::Ones(128, 100);
  candidates.maxima = maxima;
  return candidates;
}

WorkingGrid plainGrid() {
  WorkingGrid grid;
  grid.width = 100;
  grid.height = 128;
  return grid;
}

NamedJoints standing() {
  const auto at = [](double x, double y) { return std::optional(Eigen::Vector2d(x, y)); };
  return {{"head", at(50, 20)},        {"body", at(50, 60)},        {"right_shoulder", at(35, 44)},
          {"right_elbow", at(20, 60)}, {"right_hand", at(5, 70)},   {"left_shoulder", at(65, 44)},
          {"left_elbow", at(80, 60)},  {"left_hand", at(95, 70)},   {"right_hip", at(42, 80)},
          {"right_knee", at(40, 100)}, {"right_foot", at(38, 124)}, {"left_hip", at(58, 80)},
          {"left_knee", at(60, 100)},  {"left_foot", at(62, 124)}};
}

std::vector<std::optional<JointClass>> label(const std::vector<JointCandidate>& maxima,
                                             const NamedJoints& joints) {
  return labelFromJoints(candidatesAt(maxima), plainGrid(), joints, loadTemplate("biped"));
}

using Labels = std::vector<std::optional<JointClass>>;
constexpr auto kHead = JointClass::kHead, kBody = JointClass::kBody, kHand = JointClass::kHand,
               kLeg = JointClass::kLeg;

}  // namespace

TEST_CASE("candidates get the class of the nearest bone") {
  // Neck (50, 44) and head (50, 20): body below their middle (50, 32), head above, up to the top of the head.
  CHECK(label({{50, 20, 1}, {50, 1, 1}, {50, 30, 1}, {50, 34, 1}, {50, 60, 1}, {50, 78, 1}}, standing()) ==
        Labels{kHead, kHead, kHead, kBody, kBody, kBody});
  CHECK(label({{6, 70, 1}, {28, 52, 1}, {94, 70, 1}, {41, 90, 1}, {62, 120, 1}}, standing()) ==
        Labels{kHand, kHand, kHand, kLeg, kLeg});
  // Neck to shoulder and pelvis to hip count for nothing.
  CHECK(label({{44, 44, 1}}, standing()) == Labels{kBody});
}

TEST_CASE("what is nearest to a bone that nobody has placed gets no class") {
  const auto labels = [](const std::vector<JointCandidate>& maxima, const NamedJoints& joints,
                         const std::vector<std::string>& recognized) {
    return labelFromJoints(candidatesAt(maxima), plainGrid(), joints, loadTemplate("biped"), recognized);
  };
  const std::vector<JointCandidate> all = {{50, 20, 1}, {50, 52, 1}, {6, 70, 1}, {28, 52, 1}, {62, 120, 1}};
  CHECK(labels(all, standing(), {}) == Labels{kHead, kBody, kHand, kHand, kLeg});
  // The forearm goes with its hand, the upper arm stays.
  CHECK(labels(all, standing(), {"right_hand"}) == Labels{kHead, kBody, std::nullopt, kHand, kLeg});
  // The neck follows from the shoulders, and so does what hangs on it.
  CHECK(labels(all, standing(), {"left_shoulder"}) == Labels{std::nullopt, std::nullopt, kHand, kHand, kLeg});
  std::vector<std::string> everything;
  for (const auto& [name, place] : standing()) everything.push_back(name);
  CHECK(labels(all, standing(), everything) == Labels(all.size()));
  // Files of skeletons hold those that follow from others, too, as found.
  NamedJoints with_neck = standing();
  with_neck.emplace_back("neck", Eigen::Vector2d(50, 44));
  with_neck.emplace_back("pelvis", Eigen::Vector2d(50, 80));
  CHECK(labels(all, with_neck, {"neck", "pelvis"}) == labels(all, standing(), {}));
}

TEST_CASE("candidates of a limb that lacks a joint took the class of another part") {
  const auto without = [](const std::set<std::string>& missing) {
    NamedJoints joints = standing();
    for (auto& [name, place] : joints)
      if (missing.contains(name)) place.reset();
    return joints;
  };
  const std::vector<JointCandidate> left_arm = {{68, 47, 1}, {78, 58, 1}, {90, 66, 1}, {95, 71, 1}},
                                    others = {{50, 20, 1}, {50, 60, 1},  {20, 58, 1}, {8, 69, 1},
                                              {41, 90, 1}, {38, 122, 1}, {62, 122, 1}};
  const Labels others_classes = {kHead, kBody, kHand, kHand, kLeg, kLeg, kLeg};
  CHECK(label(left_arm, standing()) == Labels(4, kHand));
  for (const std::set<std::string>& missing :
       {std::set<std::string>{"left_elbow"}, {"left_elbow", "left_hand"}}) {
    CHECK(label(left_arm, without(missing)) == Labels(4));
    CHECK(label(others, without(missing)) == others_classes);
    NamedJoints unnamed = without(missing);
    std::erase_if(unnamed, [](const auto& joint) { return !joint.second; });
    CHECK(label(left_arm, unnamed) == Labels(4));
  }
  // The upper arm is known, but for its end.
  CHECK(label(left_arm, without({"left_hand"})) == Labels{kHand, kHand, std::nullopt, std::nullopt});
  CHECK(label(others, without({"left_hand"})) == others_classes);
  // The pelvis follows from the hips.
  CHECK(label({{50, 76, 1}, {58, 84, 1}, {60, 98, 1}, {38, 122, 1}, {6, 70, 1}}, without({"left_hip"})) ==
        Labels{std::nullopt, std::nullopt, std::nullopt, kLeg, kHand});
  CHECK(label({{50, 20, 1}, {50, 40, 1}, {50, 70, 1}, {20, 60, 1}}, without({"head"})) ==
        Labels{std::nullopt, std::nullopt, kBody, kHand});
  CHECK(label(left_arm, {}) == Labels(4));
  CHECK(label(left_arm, {{"left_hand", Eigen::Vector2d(95, 70)}}) == Labels(4));
  CHECK(label({}, standing()).empty());
}

TEST_CASE("a joint that is given is not derived") {
  NamedJoints joints = standing();
  joints.emplace_back("neck", Eigen::Vector2d(50, 30));
  // The middle of neck and head moves up to (50, 25).
  CHECK(label({{50, 28, 1}}, joints) == Labels{kBody});
  CHECK(label({{50, 28, 1}}, standing()) == Labels{kHead});
}

TEST_CASE("the tip of the head ends where the figure ends") {
  NamedJoints joints = standing();
  for (auto& [name, place] : joints)
    if (name == "left_hand") place = Eigen::Vector2d(92, 2);
  CandidateSet candidates = candidatesAt({{70, 2, 1}});
  CHECK(labelFromJoints(candidates, plainGrid(), joints, loadTemplate("biped")) == Labels{kHead});
  candidates.distance.topRows(15).setZero();
  CHECK(labelFromJoints(candidates, plainGrid(), joints, loadTemplate("biped")) == Labels{kHand});
}
