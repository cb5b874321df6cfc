#include "trainer/posable_drawing.h"

#include <algorithm>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/sha256.h"
#include "libskel/image/read_image.h"
#include "libskel/image/write_image.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/labels/label_file.h"
#include "libskel/skeleton/skeleton_file.h"
#include "tests/support/catch.h"
#include "tests/support/marked_figure.h"
#include "tests/support/temp_dir.h"
#include "trainer/figures/drawing.h"
#include "trainer/joint_loss.h"

namespace skel {
namespace {

const std::vector<std::string> kNames = jointNames(figurePlan("biped"));

void write(const TempDir& dir, const std::string& left_out = "", const std::string& unseen = "") {
  const MarkedFigure figure = markedFigure(kNames);
  Image mask(figure.image.width, figure.image.height);
  mask.rgba.leftCols(3) = figure.mask.reshaped<Eigen::RowMajor>().replicate(1, 3);
  mask.rgba.col(3) = 255;
  writeFile(dir.file("a.png"), encodePng(figure.image));
  writeFile(dir.file("a.mask.png"), encodePng(mask));
  std::string joints;
  for (std::size_t j = 0; j < kNames.size(); ++j) {
    if (kNames[j] == left_out) continue;
    joints += (joints.empty() ? "\"" : ", \"") + kNames[j] + "\": ";
    joints += kNames[j] == unseen ? "null"
                                  : "[" + std::to_string(figure.joints[j].x()) + ", " +
                                        std::to_string(figure.joints[j].y()) + "]";
  }
  writeFile(dir.file("a.joints.json"), "{\"view\": \"front\", \"joints\": {" + joints + "}}");
}

std::vector<PosableDrawing> read(const TempDir& dir) {
  return posableDrawings(findJointedDrawings(dir.path()), kNames, loadTemplate("biped"), 1);
}

std::string complaint(const TempDir& dir) {
  try {
    read(dir);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

int marksShown(const SmallDrawing& drawing) {
  int count = 0;
  for (std::size_t j = 0; j < drawing.joints.size(); ++j) {
    const int x = static_cast<int>(drawing.joints[j].x()), y = static_cast<int>(drawing.joints[j].y());
    if (x < 0 || y < 0 || x >= drawing.image.width || y >= drawing.image.height) continue;
    count += drawing.mask(y, x) != 0 && showsMark(drawing.image.pixel(x, y), j);
  }
  return count;
}

TEST_CASE("joints stay on their marks when a drawing is posed anew") {
  const TempDir dir;
  write(dir);
  const std::vector<PosableDrawing> drawings = read(dir);
  REQUIRE(drawings.size() == 1);
  const SmallDrawing still = asDrawn(drawings[0]);
  CHECK(marksShown(still) == static_cast<int>(kNames.size()));
  Rng rng(3);
  int shown = 0, moved = 0;
  constexpr int kPoses = 30;
  for (int i = 0; i < kPoses; ++i) {
    const SmallDrawing other = posed(rng, drawings[0]);
    shown += marksShown(other);
    const auto hand =
        static_cast<std::size_t>(std::find(kNames.begin(), kNames.end(), "right_hand") - kNames.begin());
    moved += (other.joints[hand] - still.joints[hand]).norm() > .1 * kSmallLongSide;
  }
  // An arm may cover another's mark.
  CHECK(shown >= .97 * kPoses * static_cast<double>(kNames.size()));
  CHECK(moved >= kPoses / 4);
}

TEST_CASE("the same random numbers give the same pose") {
  const TempDir dir;
  write(dir);
  const std::vector<PosableDrawing> drawings = read(dir);
  Rng one(8), other(8);
  const SmallDrawing a = posed(one, drawings[0]), b = posed(other, drawings[0]);
  CHECK((a.image.rgba == b.image.rgba).all());
  CHECK(a.joints == b.joints);
}

TEST_CASE("drawings to be posed need all joints") {
  const TempDir dir;
  CHECK(complaint(dir).find("has no drawing with known joints") != std::string::npos);
  write(dir, "left_knee");
  CHECK(complaint(dir) ==
        dir.file("a.joints.json") +
            ": joints: has no \"left_knee\"; training needs all, null where one cannot be seen");
}

TEST_CASE("of a mistyped joint only the one that is missing was named") {
  const TempDir dir;
  write(dir);
  std::string text = readFile(dir.file("a.joints.json"));
  writeFile(dir.file("a.joints.json"), text.replace(text.find("left_knee"), 9, "left_knie"));
  CHECK(complaint(dir) == dir.file("a.joints.json") +
                              ": joints: has no \"left_knee\", but \"left_knie\", which is no joint of the "
                              "template biped; training "
                              "needs all, null where one cannot be seen");
}

TEST_CASE("a joint that cannot be seen is completed and not learned") {
  const TempDir dir;
  write(dir, "", "left_knee");
  const std::vector<PosableDrawing> drawings = read(dir);
  const auto knee =
      static_cast<std::size_t>(std::find(kNames.begin(), kNames.end(), "left_knee") - kNames.begin());
  FigureOptions options;
  options.drawings = {asDrawn(drawings[0])};
  options.drawn_share = 1;
  Rng rng(4);
  const Figure figure = generateFigure(rng, options);
  const NetJoints joints = netJoints(kNames, loadTemplate("biped"));
  for (const bool mirrored : {false, true}) {
    const JointTarget target = jointTarget(figure, FramePlacement::centred(figure.mask, mirrored), joints);
    for (std::size_t j = 0; j < kNames.size(); ++j)
      CHECK((target.joints[j].weight == 0) ==
            (j == (mirrored ? static_cast<std::size_t>(joints.mirrored[knee]) : knee)));
  }
}

TEST_CASE("a skeleton counts once a person has placed a joint of it, labels before skeletons") {
  const TempDir dir;
  write(dir);
  std::vector<JointedDrawing> found = findJointedDrawings(dir.path());
  REQUIRE(found.size() == 1);
  SkeletonFile file;
  file.image_file = "a.png";
  const Image image = readImage(dir.file("a.png"));
  file.image_width = image.width;
  file.image_height = image.height;
  file.skeleton = presetSkeleton(loadTemplate("biped"), {0, 0}, {image.width - 1., image.height - 1.});
  for (const auto& [name, place] : found[0].joints)
    file.skeleton.joints[static_cast<std::size_t>(file.skeleton.index(name))].image = *place;
  file.mask = SkeletonFile::Mask{"a.mask.png", sha256(readFile(dir.file("a.mask.png")))};
  std::filesystem::remove(dir.file("a.joints.json"));

  writeFile(dir.file("a.skeleton.json"), formatSkeletonFile(file));
  CHECK(complaint(dir).find("has no drawing with known joints") != std::string::npos);
  file.skeleton.joints[3].origin = JointOrigin::kEdited;
  writeFile(dir.file("a.skeleton.json"), formatSkeletonFile(file));
  CHECK(read(dir).size() == 1);
  CHECK(findJointedDrawings(dir.path())[0].joints_file == dir.file("a.skeleton.json"));
}

TEST_CASE("a mask beside labels or a skeleton that name none was not learned from") {
  const TempDir dir;
  write(dir);
  LabelFile labels = labelImage(dir.file("a.png"), dir.file("a.mask.png"),
                                findJointedDrawings(dir.path())[0].joints, loadTemplate("biped"));
  labels.mask.reset();
  std::filesystem::remove(dir.file("a.joints.json"));
  const bool labelled = GENERATE(true, false);
  CAPTURE(labelled);
  if (labelled) {
    writeLabelFile(dir.file("a.labels.json"), labels);
  } else {
    SkeletonFile file;
    file.image_file = "a.png";
    file.image_width = labels.image_width;
    file.image_height = labels.image_height;
    file.skeleton = presetSkeleton(loadTemplate("biped"), {0, 0}, {10, 10});
    file.skeleton.joints[3].origin = JointOrigin::kEdited;
    writeFile(dir.file("a.skeleton.json"), formatSkeletonFile(file));
  }
  CHECK(findJointedDrawings(dir.path())[0].mask == dir.file("a.mask.png"));
}

TEST_CASE("what has changed since a person placed its joints is not learned from") {
  const TempDir dir;
  write(dir);
  const std::string picture = readFile(dir.file("a.png")), mask = readFile(dir.file("a.mask.png"));
  const LabelFile labels = labelImage(dir.file("a.png"), dir.file("a.mask.png"),
                                      findJointedDrawings(dir.path())[0].joints, loadTemplate("biped"));
  std::filesystem::remove(dir.file("a.joints.json"));
  SkeletonFile file;
  file.image_file = "b.png";
  file.image_sha256 = labels.image.sha256;
  file.image_width = labels.image_width;
  file.image_height = labels.image_height;
  file.skeleton =
      presetSkeleton(loadTemplate("biped"), {0, 0}, {labels.image_width - 1., labels.image_height - 1.});
  file.skeleton.joints[3].origin = JointOrigin::kEdited;
  file.mask = SkeletonFile::Mask{"b.mask.png", sha256(mask)};
  writeLabelFile(dir.file("a.labels.json"), labels);
  writeFile(dir.file("b.skeleton.json"), formatSkeletonFile(file));
  const auto searched = [&]() -> std::string {
    try {
      findJointedDrawings(dir.path());
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto says = [&](const std::string& name, const std::string& bytes) {
    for (const char* drawing : {"a", "b"}) {
      writeFile(dir.file(drawing + std::string(".png")), picture);
      writeFile(dir.file(drawing + std::string(".mask.png")), mask);
    }
    writeFile(dir.file(name), bytes);
    return searched();
  };
  CHECK(says("a.png", picture) == "");
  CHECK(says("a.png", picture + "x") == dir.file("a.labels.json") +
                                            ": image.file: \"a.png\" has changed since it was labelled; "
                                            "label it anew");
  CHECK(says("a.mask.png", mask + "x").find("a.labels.json: mask.file: \"a.mask.png\" has changed since") !=
        std::string::npos);
  CHECK(says("b.png", picture + "x") ==
        dir.file("b.skeleton.json") +
            ": image.file: \"b.png\" has changed since its joints were placed; find them anew (skel-infer)");
  CHECK(says("b.mask.png", mask + "x").find("b.skeleton.json: mask.file: \"b.mask.png\" has changed since") !=
        std::string::npos);
  for (const char* name : {"a.png", "b.png"}) writeFile(dir.file(name), picture + "x");
  CHECK(searched().ends_with("; the same of 1 more: " + dir.file("b.skeleton.json")));
}

TEST_CASE("joints of a label file that were found, not placed, are not learned from") {
  const TempDir dir;
  write(dir);
  LabelFile labels = labelImage(dir.file("a.png"), dir.file("a.mask.png"),
                                findJointedDrawings(dir.path())[0].joints, loadTemplate("biped"));
  std::filesystem::remove(dir.file("a.joints.json"));
  for (const auto& [name, place] : labels.joints) labels.recognized.push_back(name);
  writeLabelFile(dir.file("a.labels.json"), labels);
  CHECK(complaint(dir).find("of which a person has placed a joint") != std::string::npos);
  labels.recognized.pop_back();
  writeLabelFile(dir.file("a.labels.json"), labels);
  CHECK(read(dir).size() == 1);
}

TEST_CASE("what a person has placed in a label file is learned from, not the joints file beside it") {
  const TempDir dir;
  write(dir, "", "left_hand");
  const JointedDrawing before = findJointedDrawings(dir.path())[0];
  LabelFile labels =
      labelImage(dir.file("a.png"), dir.file("a.mask.png"), before.joints, loadTemplate("biped"));
  const auto found = [&] {
    writeLabelFile(dir.file("a.labels.json"), labels);
    return findJointedDrawings(dir.path())[0];
  };
  const auto set = [](NamedJoints& joints, const std::string& name, const Eigen::Vector2d& place) {
    for (auto& [joint, at] : joints)
      if (joint == name) at = place;
  };
  CHECK(found().joints == before.joints);
  CHECK(found().joints_file == dir.file("a.joints.json"));
  CHECK(contentOf({found()}) == contentOf({before}));

  NamedJoints mended = before.joints;
  for (NamedJoints* joints : {&mended, &labels.joints}) {
    set(*joints, "left_hand", {7, 8});
    set(*joints, "head", {9, 10});
  }
  set(labels.joints, "left_foot", {11, 12});  // found, not placed
  labels.recognized = {"left_foot"};
  CHECK(found().joints == mended);
  CHECK(found().joints_file == dir.file("a.labels.json"));
  writeFile(dir.file("a.mask.png"), readFile(dir.file("a.mask.png")) + "x");
  CHECK(complaint(dir).find("a.labels.json: mask.file: \"a.mask.png\" has changed") != std::string::npos);
}

}  // namespace
}  // namespace skel
