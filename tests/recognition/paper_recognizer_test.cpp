#include "libskel/recognition/paper_recognizer.h"

#include <algorithm>
#include <cmath>

#include "tests/support/catch.h"

using namespace skel;
using Eigen::Vector2d;

namespace {

constexpr int kWidth = 320, kHeight = 400;

struct Capsule {
  Vector2d a, b;
  double radius;
  JointClass joint_class;
};

// A plain figure with its arms half out; its joints are the capsules' ends.
const std::vector<Capsule> kFigure = {
    {{160, 70}, {160, 70}, 50, JointClass::kHead},   {{160, 150}, {160, 230}, 42, JointClass::kBody},
    {{122, 140}, {75, 190}, 12, JointClass::kHand},  {{75, 190}, {30, 240}, 12, JointClass::kHand},
    {{198, 140}, {245, 190}, 12, JointClass::kHand}, {{245, 190}, {290, 240}, 12, JointClass::kHand},
    {{140, 262}, {132, 320}, 14, JointClass::kLeg},  {{132, 320}, {125, 380}, 14, JointClass::kLeg},
    {{180, 262}, {188, 320}, 14, JointClass::kLeg},  {{188, 320}, {195, 380}, 14, JointClass::kLeg}};

double distance(const Capsule& c, const Vector2d& p) {
  const double length = (c.b - c.a).squaredNorm();
  const double t = length > 0 ? std::clamp((p - c.a).dot(c.b - c.a) / length, 0.0, 1.0) : 0;
  return (p - c.a - t * (c.b - c.a)).norm() - c.radius;
}

Silhouette figure() {
  Plane8 mask = Plane8::Zero(kHeight, kWidth);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (const Capsule& c : kFigure)
        if (distance(c, {x, y}) <= 0) mask(y, x) = 255;
  return silhouetteFromMask(mask);
}

// What a perfect net would say: the class of the capsule that a candidate lies deepest in, relative to its
// radius.
ClassProbabilities trueClasses(const Silhouette& silhouette, const CandidateSet& candidates) {
  ClassProbabilities classes = ClassProbabilities::Constant(candidates.maxima.size(), 4, 0.02f);
  for (size_t i = 0; i < candidates.maxima.size(); ++i) {
    const Vector2d p = silhouette.grid.imageFromGrid({candidates.maxima[i].x, candidates.maxima[i].y});
    const auto best =
        std::min_element(kFigure.begin(), kFigure.end(), [&](const Capsule& a, const Capsule& b) {
          return distance(a, p) / a.radius < distance(b, p) / b.radius;
        });
    classes(static_cast<Eigen::Index>(i), static_cast<int>(best->joint_class)) = 0.94f;
  }
  return classes;
}

}  // namespace

TEST_CASE("lines are groups of touching discs with their class shares") {
  CandidateSet candidates;
  candidates.maxima = {{10, 10, 4}, {30, 10, 3}, {16, 10, 2}, {35, 10, 2}, {38, 10, 1}};
  ClassProbabilities classes = ClassProbabilities::Zero(5, 4);
  for (int i : {0, 2}) classes(i, 0) = 1;
  for (int i : {1, 3}) classes(i, 2) = 1;
  classes(4, 3) = 1;
  const auto lines = candidateLines(candidates, {0, 1, 2, 3, 4}, classes, 1);
  REQUIRE(lines.size() == 2);
  CHECK(lines[0].members == std::vector<int>{1, 3, 4});
  CHECK(lines[0].class_share[2] == Approx(2.0 / 3));
  CHECK(lines[0].class_share[3] == Approx(1.0 / 3));
  CHECK(lines[0].mean_radius == Approx(2));
  CHECK(lines[1].members == std::vector<int>{0, 2});
  CHECK(lines[1].class_share[0] == 1);
  CHECK(candidateLines(candidates, {0, 1, 2, 3, 4}, classes, 3).size() == 1);
  CHECK(candidateLines(candidates, {}, classes, 1).empty());
}

TEST_CASE("lines of thousands of discs that all touch each other are found in steps of pairs") {
  CandidateSet candidates;
  std::vector<int> members;
  for (int i = 0; i < 8000; ++i) {
    candidates.maxima.push_back({float(i % 128), float(i / 128), 1});
    members.push_back(i);
  }
  const ClassProbabilities classes = ClassProbabilities::Constant(8000, 4, 0.25);
  CHECK(candidateLines(candidates, members, classes, 100).size() == 1);
}

TEST_CASE("the rules find a plain figure whose classes are known") {
  const Silhouette silhouette = figure();
  REQUIRE(silhouette.found());
  const CandidateSet candidates = extractCandidates(silhouette);
  SkeletonTemplate biped = loadTemplate("biped");
  biped.rules.limb_radius = 1;  // (3) as printed asks for thinner limbs than this figure's
  const Recognition recognition =
      recognizeByRules(silhouette, candidates, trueClasses(silhouette, candidates), biped);
  const auto at = [&](const char* name) {
    return recognition.skeleton.joints[static_cast<size_t>(recognition.skeleton.index(name))].image;
  };
  constexpr double kNear_px = 0.12 * kHeight;  // lines end where the last disc does, short of the hand
  CHECK((at("head") - Vector2d(160, 70)).norm() < kNear_px);
  CHECK((at("body") - Vector2d(160, 190)).norm() < kNear_px);
  CHECK((at("right_hand") - Vector2d(30, 240)).norm() < kNear_px);
  CHECK((at("left_hand") - Vector2d(290, 240)).norm() < kNear_px);
  CHECK((at("right_foot") - Vector2d(125, 380)).norm() < kNear_px);
  CHECK((at("left_foot") - Vector2d(195, 380)).norm() < kNear_px);
  CHECK((at("left_elbow") - Vector2d(245, 190)).norm() < kNear_px);
  CHECK(recognition.missing.empty());
  CHECK(recognition.confidence > 0);
}

TEST_CASE("the numbers of the rules are the template's") {
  const Silhouette silhouette = figure();
  const CandidateSet candidates = extractCandidates(silhouette);
  const ClassProbabilities classes = trueClasses(silhouette, candidates);
  const auto missing = [&](const SkeletonTemplate& body_plan) {
    return recognizeByRules(silhouette, candidates, classes, body_plan).missing.size();
  };
  SkeletonTemplate biped = loadTemplate("biped");
  CHECK(missing(biped) == 12);
  biped.rules.limb_radius = 1;
  CHECK(missing(biped) == 0);
  biped.rules.limb_probability = 1.01;
  CHECK(missing(biped) == 12);
  biped.rules.limb_probability = 0.5;
  biped.rules.line_reach = 100;
  CHECK(missing(biped) > 0);
}

TEST_CASE("where nothing is recognised, the preset stands in and says so") {
  const Silhouette silhouette = figure();
  const CandidateSet candidates = extractCandidates(silhouette);
  // All candidates are body: no limb, and the head is the largest disc above the body.
  ClassProbabilities classes = ClassProbabilities::Zero(candidates.maxima.size(), 4);
  classes.col(1).setOnes();
  const Recognition recognition = recognizeByRules(silhouette, candidates, classes, loadTemplate("biped"));
  CHECK(recognition.missing.size() == 12);
  const Skeleton& skeleton = recognition.skeleton;
  CHECK(skeleton.joints[skeleton.index("left_hand")].origin == JointOrigin::kCompleted);
  CHECK((skeleton.joints[skeleton.index("head")].image - Vector2d(160, 70)).norm() < 20);
  for (const Joint& joint : skeleton.joints)
    CHECK(silhouette.mask(std::lround(joint.image.y()), std::lround(joint.image.x())) == 255);
}

TEST_CASE("degenerate figures get a skeleton that lies on them") {
  for (const auto& [height, width] : {std::pair{1, 40}, {40, 1}, {3, 3}, {64, 64}}) {
    const Silhouette silhouette = silhouetteFromMask(Plane8::Constant(height, width, 255));
    if (!silhouette.found()) continue;
    for (const CandidateMethod method :
         {CandidateMethod::kMaxima, CandidateMethod::kStrict, CandidateMethod::kDiscs}) {
      const CandidateSet candidates = extractCandidates(silhouette, {.method = method});
      const ClassProbabilities classes = ClassProbabilities::Constant(candidates.maxima.size(), 4, 0.25f);
      const Recognition recognition =
          recognizeByRules(silhouette, candidates, classes, loadTemplate("biped"));
      for (const Joint& joint : recognition.skeleton.joints) {
        CHECK(joint.image.allFinite());
        CHECK(silhouette.mask(std::lround(joint.image.y()), std::lround(joint.image.x())) == 255);
      }
    }
  }
}
