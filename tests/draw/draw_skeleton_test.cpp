#include "libskel/draw/draw_skeleton.h"

#include "tests/support/catch.h"
#include "tests/support/figure.h"

using namespace skel;

namespace {

Color at(const Image& image, const Eigen::Vector2d& p) {
  const std::uint8_t* pixel = image.pixel(int(std::lround(p.x())), int(std::lround(p.y())));
  return {pixel[0], pixel[1], pixel[2]};
}

bool same(Color a, Color b) { return a.r == b.r && a.g == b.g && a.b == b.b; }

}  // namespace

TEST_CASE("left, right and middle joints have their colours, doubtful ones are hollow") {
  Skeleton skeleton = figureSkeleton();
  skeleton.joints[skeleton.index("left_knee")].confidence = 0.2;
  Image image = blankImage(600, 600, {20, 20, 20});
  drawSkeleton(image, skeleton);
  for (const Joint& joint : skeleton.joints)
    CHECK(same(at(image, joint.image), joint.name == "left_knee" ? kWhite : sideColor(joint.name)));
  CHECK_FALSE(same(sideColor("left_hand"), sideColor("right_hand")));

  const Image before = image;
  drawSkeleton(image, Skeleton());
  CHECK((image.rgba == before.rgba).all());
}
