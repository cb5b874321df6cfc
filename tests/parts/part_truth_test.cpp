// What is known of the parts of painted and generated figures.
#include "trainer/part_truth.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "tests/support/catch.h"
#include "trainer/held_things.h"
#include "trainer/part_samples.h"
#include "trainer/posed_parts.h"

namespace skel {
namespace {

// A figure of 100 x 200 px in a picture of 320: shapes in the order that they are painted in.
struct Painting {
  cv::Mat shapes = cv::Mat(320, 320, CV_8UC3, cv::Scalar(0, 0, 0));
  PartSkeleton skeleton;
  int count = 0;

  Painting() {
    skeleton.head = {160, 85}, skeleton.body = {160, 150};
    skeleton.limbs = {{{{{130, 115}, {125, 150}, {125, 185}}},
                       {{{190, 115}, {195, 150}, {160, 160}}},
                       {{{145, 190}, {143, 220}, {142, 250}}},
                       {{{175, 190}, {177, 220}, {178, 250}}}}};
    paint(cv::Rect(135, 180, 20, 75));    // right leg
    paint(cv::Rect(165, 180, 20, 75));    // left leg
    paint(cv::Rect(130, 105, 60, 90));    // trunk
    paint(cv::Rect(140, 60, 40, 45));     // head
    paint(cv::Rect(117, 110, 15, 80));    // right arm
    const cv::Scalar arm(++count, 0, 0);  // left arm, across the chest
    cv::line(shapes, {190, 115}, {195, 150}, arm, 12);
    cv::line(shapes, {195, 150}, {160, 160}, arm, 12);
  }
  void paint(const cv::Rect& box) { shapes(box).setTo(cv::Scalar(++count, 0, 0)); }
  Part at(int x, int y) const {
    const auto truth = partTruth(shapes, skeleton);
    REQUIRE(truth.has_value());
    return static_cast<Part>(truth->part.at<std::uint8_t>(y, x));
  }
};

TEST_CASE("a shape along a limb's bones is that limb, also where it lies before the chest") {
  const Painting painting;
  CHECK(painting.at(160, 130) == Part::kTrunk);
  CHECK(painting.at(160, 80) == Part::kHead);
  CHECK(painting.at(124, 140) == Part::kRightArm);
  CHECK(painting.at(180, 155) == Part::kLeftArm);
  CHECK(painting.at(163, 160) == Part::kLeftArm);
  CHECK(painting.at(145, 230) == Part::kRightLeg);
  CHECK(painting.at(175, 230) == Part::kLeftLeg);
  CHECK(static_cast<int>(painting.at(10, 10)) == kNoPart);
}

TEST_CASE(
    "a figure posed anew has its limbs' pixels along their turned bones, before the body or behind it") {
  const Painting painting;
  const auto truth = partTruth(painting.shapes, painting.skeleton);
  REQUIRE(truth.has_value());
  PartSample drawn;
  drawn.rgb = cv::Mat(320, 320, CV_8UC3, cv::Scalar::all(200));
  drawn.part = truth->part, drawn.order = truth->order, drawn.mask = truth->part != kNoPart;
  drawn.skeleton = painting.skeleton;
  int turned = 0, bare = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Rng rng(seed, 1), again(seed, 1);
    const PartSample posed = posedPartSample(rng, drawn), twin = posedPartSample(again, drawn);
    CHECK(cv::norm(posed.part, twin.part, cv::NORM_INF) == 0);
    CHECK(cv::countNonZero((posed.part == kNoPart) != (posed.mask == 0)) == 0);
    for (int k = 0; k < 4; ++k) {
      CAPTURE(seed, k);
      const auto& bones = posed.skeleton.limbs[std::size_t(k)];
      for (const Eigen::Vector2d& joint : {Eigen::Vector2d((bones[0] + bones[1]) / 2), bones[1], bones[2]}) {
        const int is = posed.part.at<std::uint8_t>(int(joint.y()), int(joint.x()));
        bare += is == kNoPart;
        // Nobody but another part that lies before it may stand there.
        const bool own = is == int(limbPart(k));
        CHECK((own || posed.order.at<std::uint16_t>(int(joint.y()), int(joint.x())) > 0));
        turned += own;
      }
    }
    const auto across = limbsBefore(posed);
    CHECK(*std::max_element(across.begin(), across.end()) == 1);
  }
  CHECK(bare == 0);
  CHECK(turned > 12 * 4 * 3 / 2);
}

TEST_CASE("things that are given to a figure are things, cover what lies behind them, and leave its joints") {
  const auto truth = partTruth(Painting().shapes, Painting().skeleton);
  REQUIRE(truth.has_value());
  PartSample bare;
  bare.rgb = cv::Mat(320, 320, CV_8UC3, cv::Scalar::all(200));
  bare.part = truth->part, bare.order = truth->order, bare.mask = truth->part != kNoPart;
  bare.skeleton = Painting().skeleton;
  int held = 0;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    CAPTURE(seed);
    Rng rng(seed, 1), again(seed, 1);
    const PartSample given = withThings(rng, bare, bare), twin = withThings(again, bare, bare);
    CHECK(cv::norm(given.part, twin.part, cv::NORM_INF) == 0);
    CHECK(cv::norm(given.rgb, twin.rgb, cv::NORM_INF) == 0);
    CHECK(cv::countNonZero((given.part == kNoPart) != (given.mask == 0)) == 0);
    CHECK(cv::countNonZero(given.part == int(Part::kThing)) > 0);
    // Its skeleton is the bare one's, moved and scaled.
    const auto& bones = given.skeleton.limbs[0];
    const double unit =
        (bones[1] - bones[0]).norm() / (bare.skeleton.limbs[0][1] - bare.skeleton.limbs[0][0]).norm();
    CHECK((given.skeleton.head - given.skeleton.body).norm() ==
          Approx(unit * (bare.skeleton.head - bare.skeleton.body).norm()).epsilon(0.02));
    const cv::Point hand(int(bones[2].x()), int(bones[2].y()));
    held += given.part.at<std::uint8_t>(hand) == int(Part::kThing);
  }
  CHECK(held > 0);
  CHECK(cv::countNonZero(bare.part == int(Part::kThing)) == 0);  // what was given is a copy
}

TEST_CASE("a shape over both legs and what is between them is a skirt, no leg") {
  Painting painting;
  painting.paint(cv::Rect(125, 185, 70, 55));
  CHECK(painting.at(160, 220) == Part::kSkirt);
  CHECK(painting.at(145, 220) == Part::kSkirt);
  CHECK(painting.at(145, 250) == Part::kRightLeg);
}

TEST_CASE("what is far from all bones but at the hand is a thing, a button is of what is around it") {
  Painting painting;
  painting.paint(cv::Rect(70, 180, 50, 6));
  painting.paint(cv::Rect(158, 120, 4, 4));
  CHECK(painting.at(80, 183) == Part::kThing);
  CHECK(painting.at(160, 122) == Part::kTrunk);
}

TEST_CASE("a drawing in one shape is divided along its bones, an empty one has no parts") {
  Painting painting;
  cv::Mat& shapes = painting.shapes;
  for (int y = 0; y < shapes.rows; ++y)
    for (int x = 0; x < shapes.cols; ++x)
      if (shapes.at<cv::Vec3b>(y, x)[0] != 0) shapes.at<cv::Vec3b>(y, x) = {1, 0, 0};
  CHECK(painting.at(143, 230) == Part::kRightLeg);
  CHECK(painting.at(160, 80) == Part::kHead);
  shapes.setTo(cv::Scalar::all(0));
  CHECK_FALSE(partTruth(shapes, painting.skeleton).has_value());
}

TEST_CASE("generated figures know their parts, and which limb lies before others") {
  int before = 0, limbs = 0;
  for (const char* plan : {"biped", "quadruped"})
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      Rng rng(seed);
      const PartSample sample = generatedPartSample(rng, plan);
      CHECK(std::max(sample.mask.cols, sample.mask.rows) == kPartNetSize);
      CHECK(sample.part.size() == sample.mask.size());
      CHECK(sample.skeleton.animal == (std::string(plan) == "quadruped"));
      CHECK(cv::countNonZero((sample.mask == 0) & (sample.part != kNoPart)) == 0);
      for (const int b : limbsBefore(sample)) before += b == 1, limbs += b >= 0;
      // Mirrored and turned, sides are still the picture's.
      const PartSample warped = warpedPartSample(rng, sample);
      CHECK(std::max(warped.mask.cols, warped.mask.rows) == kPartNetSize);
      for (int k = 0; k < 4; ++k) {
        const auto area = [&](const PartSample& of, int limb) {
          return static_cast<double>(cv::countNonZero(of.part == static_cast<int>(limbPart(limb)))) /
                 cv::countNonZero(of.mask);
        };
        CHECK(std::min(std::abs(area(warped, k) - area(sample, k)),
                       std::abs(area(warped, k) - area(sample, k ^ 1))) < .05);
      }
    }
  CHECK(before > 10);
  CHECK(before < limbs);
}

}  // namespace
}  // namespace skel
