#include <cstdlib>
#include <numbers>
#include <optional>

#include "libskel/image/read_image.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/pipeline/facing.h"
#include "libskel/pipeline/rig_character.h"
#include "libskel/recognition/facing_net.h"
#include "tests/support/catch.h"

namespace skel {
namespace {

RiggedCharacter modelOf(Image image, Plane8 mask) {
  RigInput input;
  input.image = std::move(image);
  input.mask = std::move(mask);
  RigOptions options;
  options.last = LastStage::kModel;
  return rigCharacter(std::move(input), options).character;
}

Image mirrored(const Image& image) {
  Image out(image.width, image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 4; ++c) out.pixel(image.width - 1 - x, y)[c] = image.pixel(x, y)[c];
  return out;
}

TEST_CASE("a drawing and its mirror image look to opposite sides") {
  const std::string name = SKEL_DATASETS "/unseen/characters/kd5_runner_bent_legs_side";
  const Image image = readImage(name + ".png");
  const Plane8 mask = readMaskOf(image, name + ".mask.png");
  const double one = facing(modelOf(image, mask)),
               other = facing(modelOf(mirrored(image), mask.rowwise().reverse()));
  CHECK(one > 0);
  CHECK(other == -one);
}

TEST_CASE("the evidence of a mirror image is the same with left and right exchanged") {
  const std::string name = SKEL_DATASETS "/unseen/characters/kungfu";
  const Image image = readImage(name + ".png");
  const Plane8 mask = readMaskOf(image, name + ".mask.png");
  Skeleton skeleton = modelOf(image, mask).skeleton;
  const auto evidence = facingEvidence(skeleton, silhouetteFromMask(mask), 0);
  REQUIRE(evidence);
  for (Joint& joint : skeleton.joints) {
    joint.image.x() = image.width - 1 - joint.image.x();
    if (joint.name.starts_with("left_"))
      joint.name = "right_" + joint.name.substr(5);
    else if (joint.name.starts_with("right_"))
      joint.name = "left_" + joint.name.substr(6);
  }
  const auto other = facingEvidence(skeleton, silhouetteFromMask(mask.rowwise().reverse()), 0);
  REQUIRE(other);
  CHECK((evidence->sided + other->sided).cwiseAbs().maxCoeff() < .02);
  CHECK((evidence->unsided - other->unsided).cwiseAbs().maxCoeff() < .02);

  // The same figure turned by a quarter.
  for (Joint& joint : skeleton.joints)
    joint.image = Eigen::Vector2d(image.height - 1 - joint.image.y(), joint.image.x());
  const Plane8 turned = mask.rowwise().reverse().eval().transpose().rowwise().reverse();
  const auto lying = facingEvidence(skeleton, silhouetteFromMask(turned), std::numbers::pi / 2);
  REQUIRE(lying);
  CHECK((lying->sided - other->sided).cwiseAbs().maxCoeff() < .1);
  CHECK((lying->unsided - other->unsided).cwiseAbs().maxCoeff() < .1);
  skeleton.joints.back().name = "something";
  CHECK(!facingEvidence(skeleton, silhouetteFromMask(turned), 0));
}

TEST_CASE(
    "who is drawn from the side shows the same on the other, unless somebody says that he looks at us") {
  const std::string name = SKEL_DATASETS "/unseen/characters/flat_sideroad_runner";
  RigInput input;
  input.image = readImage(name + ".png");
  input.mask = readMaskOf(input.image, name + ".mask.png");
  RigOptions options;
  options.last = LastStage::kModel;
  options.layers = false;
  const auto textureOf = [&] { return rigCharacter(RigInput(input), options).character.mesh.texture.rgba; };
  const auto by_itself = textureOf();
  const auto same = [](const auto& a, const auto& b) { return a.rows() == b.rows() && (a == b).all(); };
  options.facing_rad = std::numbers::pi / 2;
  options.back = Back::kSame;
  const auto same_back = textureOf();
  options.facing_rad = 0;
  options.back.reset();
  const auto front = textureOf();
  options.back = Back::kPlain;
  CHECK(same(front, textureOf()));
  CHECK_FALSE(same(front, same_back));
  CHECK(same(by_itself, same_back));
}

TEST_CASE("of drawings that nothing was learned from most look the way that people say") {
  int sides = 0, right = 0, opposite = 0, seen = 0;
  for (const AnnotatedImage& files : findAnnotatedImages(SKEL_DATASETS "/unseen/characters")) {
    const std::optional<int> truth_deg = readFacing(files.joints);
    if (!truth_deg || std::abs(*truth_deg) != 90 || seen++ % 4 != 0) continue;
    const Image image = readImage(files.image);
    const double found = facing(modelOf(image, readMaskOf(image, files.mask.value())));
    ++sides;
    right += found * *truth_deg > 0;
    opposite += found * *truth_deg < 0;
  }
  CHECK(sides == 22);
  CHECK(right >= 18);
  CHECK(opposite <= 3);
}

}  // namespace
}  // namespace skel
