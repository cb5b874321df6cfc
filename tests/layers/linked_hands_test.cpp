// Whether both hands hold one thing.
#include "libskel/layers/linked_hands.h"

#include "tests/support/catch.h"

using namespace skel;

namespace {

// Raised arms, 100 px apart, of a picture that shows each px of the drawing.
struct Lifter {
  PartPicture picture;
  PartSkeleton skeleton;

  Lifter() {
    picture.box = {0, 0, 200, 240};
    picture.mask = picture.part = Plane8::Zero(240, 200);
    paint(60, 80, 80, 140, Part::kTrunk);
    skeleton.limbs[0] = {Eigen::Vector2d(65, 90), {50, 60}, {50, 20}};
    skeleton.limbs[1] = {Eigen::Vector2d(135, 90), {150, 60}, {150, 20}};
    paint(44, 14, 12, 76, Part::kRightArm);
    paint(144, 14, 12, 76, Part::kLeftArm);
  }
  void paint(int x, int y, int width, int height, Part part) {
    picture.mask.block(y, x, height, width).setConstant(255);
    picture.part.block(y, x, height, width).setConstant(static_cast<std::uint8_t>(part));
  }
  bool areLinked() const { return areHandsLinked(picture, skeleton); }
};

}  // namespace

TEST_CASE("a barbell in both hands links them, also where it was taken for the arms in part") {
  Lifter lifter;
  CHECK_FALSE(lifter.areLinked());
  lifter.paint(56, 14, 88, 8, Part::kThing);
  CHECK(lifter.areLinked());
  lifter.paint(56, 14, 30, 8, Part::kRightArm);
  CHECK(lifter.areLinked());
  lifter.paint(90, 14, 20, 8, Part::kTrunk);
  CHECK_FALSE(lifter.areLinked());
}

TEST_CASE("a thing in each hand, or at one elbow, links no hands") {
  Lifter lifter;
  lifter.paint(56, 10, 20, 20, Part::kThing);
  lifter.paint(124, 10, 20, 20, Part::kThing);
  CHECK_FALSE(lifter.areLinked());
  lifter.paint(56, 55, 88, 8, Part::kThing);
  CHECK_FALSE(lifter.areLinked());
}

TEST_CASE("hands that touch are linked, hands that lie beside each other on the body are not") {
  Lifter lifter;
  lifter.skeleton.limbs[0][2] = {85, 100}, lifter.skeleton.limbs[1][2] = {115, 100};
  lifter.paint(44, 96, 44, 8, Part::kRightArm);
  lifter.paint(112, 96, 44, 8, Part::kLeftArm);
  CHECK_FALSE(lifter.areLinked());
  lifter.paint(88, 96, 12, 8, Part::kRightArm);
  lifter.paint(100, 96, 12, 8, Part::kLeftArm);
  CHECK(lifter.areLinked());
}
