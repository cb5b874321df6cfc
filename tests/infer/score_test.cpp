#include "infer/annotation.h"

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/image/write_image.h"
#include "libskel/skeleton/template.h"
#include "tests/support/catch.h"
#include "tests/support/temp_dir.h"

using namespace skel;
using Eigen::Vector2d;

namespace {

const SkeletonTemplate kBiped = loadTemplate("biped");

// A block 100 px high with a joint at each scored name's preset.
MeasuredDrawing block(Recognition& perfect) {
  MeasuredDrawing drawing;
  drawing.image = Image(60, 120);
  drawing.image.rgba.setConstant(255);
  drawing.mask = Plane8::Zero(120, 60);
  drawing.mask->block(10, 5, 100, 50).setConstant(255);
  perfect.skeleton = presetSkeleton(kBiped, {5, 10}, {54, 109});
  perfect.confidence = 0.7;
  for (Joint& joint : perfect.skeleton.joints) {
    joint.confidence = 0.9;
    drawing.joints[joint.name] = joint.image;
  }
  return drawing;
}

}  // namespace

TEST_CASE("a perfect result scores full marks") {
  Recognition perfect;
  const MeasuredDrawing truth = block(perfect);
  const Score s = score(truth, &perfect, *truth.mask, kBiped);
  CHECK(s.pck05 == 1);
  CHECK(s.pck10 == 1);
  CHECK(s.error == 0);
  CHECK(s.usable == 1);
  CHECK(s.limbs == 1);
  CHECK(s.inside == 1);
  CHECK(s.iou == 1);
  CHECK(s.annotated == 14);
  CHECK(s.sure == 14);
  CHECK(s.sure_right == 14);
}

TEST_CASE("one joint off by a tenth and more is counted as such") {
  Recognition guess;
  const MeasuredDrawing truth = block(guess);
  guess.skeleton.joints[guess.skeleton.index("left_hand")].image.y() += 12;
  const Score s = score(truth, &guess, Plane8::Zero(120, 60), kBiped);
  CHECK(s.pck10 == Approx(13.0 / 14));
  CHECK(s.usable == 1);
  CHECK(s.error == Approx(0.12 / 14));
  CHECK(s.worst_joint == "left_hand");
  CHECK(s.sure_right == 13);
  CHECK(s.iou == 0);
  guess.skeleton.joints[guess.skeleton.index("left_hand")].image.y() += 12;
  CHECK(score(truth, &guess, *truth.mask, kBiped).usable == 0);
}

TEST_CASE("nothing found scores nothing") {
  Recognition perfect;
  const MeasuredDrawing truth = block(perfect);
  const Score s = score(truth, nullptr, *truth.mask, kBiped);
  CHECK(s.pck10 == 0);
  CHECK(s.error == 1);
  CHECK(s.annotated == 14);
}

TEST_CASE(
    "without a true mask joints are measured, by the size of what was found, and the silhouette is not") {
  Recognition guess;
  MeasuredDrawing truth = block(guess);
  const Plane8 silhouette = *truth.mask;
  truth.mask.reset();
  guess.skeleton.joints[guess.skeleton.index("left_hand")].image.y() += 12;
  const Score s = score(truth, &guess, silhouette, kBiped);
  CHECK(s.pck10 == Approx(13.0 / 14));
  CHECK(s.error == Approx(0.12 / 14));
  CHECK(s.limbs == 1);
  CHECK_FALSE(s.inside);
  CHECK_FALSE(s.iou);
  CHECK_FALSE(score(truth, nullptr, silhouette, kBiped).iou);

  MeasuredDrawing head_alone;
  head_alone.joints["head"] = truth.joints["head"];
  CHECK_FALSE(score(head_alone, &guess, silhouette, kBiped).limbs);
}

TEST_CASE("in side views a pair of limbs may be swapped") {
  Recognition guess;
  MeasuredDrawing truth = block(guess);
  for (const char* part : {"shoulder", "elbow", "hand"})
    std::swap(guess.skeleton.joints[guess.skeleton.index(std::string("left_") + part)].image,
              guess.skeleton.joints[guess.skeleton.index(std::string("right_") + part)].image);
  CHECK(score(truth, &guess, *truth.mask, kBiped).pck10 < 1);
  truth.side_view = true;
  CHECK(score(truth, &guess, *truth.mask, kBiped).pck10 == 1);
}

TEST_CASE("four quarter turns bring a drawing back") {
  Recognition perfect;
  MeasuredDrawing truth = block(perfect);
  const MeasuredDrawing before = truth;
  turnClockwise(truth, 1);
  CHECK(truth.image.width == 120);
  CHECK(truth.mask->rows() == 60);
  // What was at the top is at the right.
  CHECK(truth.joints["head"]->x() > truth.joints["body"]->x());
  turnClockwise(truth, 3);
  CHECK((truth.image.rgba == before.image.rgba).all());
  CHECK((*truth.mask == *before.mask).all());
  CHECK(truth.joints["left_hand"]->isApprox(*before.joints.at("left_hand")));
}

TEST_CASE("a true mask of another size than its picture is refused") {
  const TempDir dir;
  Image image(4, 3);
  image.rgba.setConstant(255);
  writeFile(dir.file("a/image.png"), encodePng(image));
  writeFile(dir.file("a/mask.png"), encodePng(Plane8(Plane8::Zero(4, 3))));
  CHECK_THROWS_AS(readMeasuredDrawing(dir.path(), "a"), InputError);
}
