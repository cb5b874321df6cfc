#include "libskel/labels/label_folder.h"

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/sha256.h"
#include "libskel/image/write_image.h"
#include "libskel/labels/annotated_image.h"
#include "tests/support/catch.h"
#include "tests/support/locked_folder.h"
#include "tests/support/temp_dir.h"

using namespace skel;

namespace {

LabelFile fourClasses(const std::string& image) {
  LabelFile file;
  file.image = {image, sha256("picture")};
  file.image_width = file.image_height = 200;
  file.grid_width = 100;
  file.grid_height = 128;
  for (int c = 0; c < kJointClassCount; ++c) {
    file.candidates.push_back({10.f * static_cast<float>(c), 20.f * static_cast<float>(c), 2});
    file.labels.emplace_back(static_cast<JointClass>(c));
  }
  return file;
}

void put(const TempDir& dir, const std::string& stem, const LabelFile& labels) {
  writeFile(dir.file(stem + ".png"), "picture");
  writeLabelFile(dir.file(stem + ".labels.json"), labels);
}

std::string complaint(const TempDir& dir) {
  try {
    readLabelledSet(dir.path());
  } catch (const InputError& error) {
    const std::string line = error.what();
    return line.starts_with(dir.path()) ? line.substr(dir.path().size()) : "not of this folder: " + line;
  }
  return "none";
}

// A figure of rectangles: trunk with head, arms and legs.
Plane8 blockMan() {
  Plane8 mask = Plane8::Zero(200, 160);
  mask.block(10, 60, 40, 40) = 255;
  mask.block(50, 50, 70, 60) = 255;
  mask.block(60, 10, 14, 140) = 255;
  mask.block(120, 55, 70, 16) = 255;
  mask.block(120, 90, 70, 16) = 255;
  return mask;
}

constexpr const char* kBlockManJoints = R"({"joints": {"head": [80, 30], "torso": [80, 85],
  "right_shoulder": [52, 66], "right_elbow": [32, 66], "right_hand": [12, 66],
  "left_shoulder": [108, 66], "left_elbow": [128, 66], "left_hand": [148, 66],
  "right_hip": [63, 120], "right_knee": [63, 150], "right_foot": [63, 186],
  "left_hip": [98, 120], "left_knee": [98, 150], "left_foot": [98, 186]}})";

}  // namespace

TEST_CASE("a folder of label files becomes one set, sorted by name") {
  const TempDir dir;
  put(dir, "b", fourClasses("b.png"));
  put(dir, "a/c", fourClasses("c.png"));
  const LabelledSet set = readLabelledSet(dir.path());
  REQUIRE(set.characters.size() == 2);
  CHECK(set.characters[0].name == "a/c");
  CHECK(set.characters[1].name == "b");
  CHECK(set.sampleCount() == 8);
  CHECK(set.classCounts() == std::array{2, 2, 2, 2});
  CHECK(set.characters[0].features.row(3) == Eigen::RowVector3f(1, 1, 0.5));
  CHECK(checkLabelFolder(dir.path()).empty());

  LabelFile changed = fourClasses("b.png");
  changed.labels[0] = JointClass::kLeg;
  put(dir, "b", changed);
  CHECK(readLabelledSet(dir.path()).sha256 != set.sha256);
}

TEST_CASE("sets that cannot be trained on are refused") {
  const TempDir dir;
  CHECK(complaint(dir) == ": holds no label files (*.labels.json)");
  CHECK_THROWS_WITH(readLabelledSet(dir.file("none")), dir.file("none") + ": does not exist");

  LabelFile labels = fourClasses("a.png");
  labels.labels[2].reset();
  put(dir, "a", labels);
  CHECK(readLabelledSet(dir.path()).sampleCount() == 3);
  CHECK(readLabelledSet(dir.path()).leftOut() ==
        std::vector<std::string>{"1 candidate without a class left out"});
  CHECK(checkLabelFolder(dir.path()).empty());  // still in the making

  labels.labels.assign(labels.labels.size(), std::nullopt);
  put(dir, "a", labels);
  CHECK_THAT(complaint(dir), Catch::Matchers::StartsWith(": no candidate has a class; place joints, or "));
  put(dir, "b", fourClasses("b.png"));
  CHECK(readLabelledSet(dir.path()).characters.size() == 1);
  CHECK_THAT(readLabelledSet(dir.path()).leftOut().front(),
             Catch::Matchers::StartsWith("1 drawing without a class of any candidate, left out: "));
  std::filesystem::remove(dir.file("b.labels.json"));

  labels = fourClasses("a.png");
  labels.labels[2] = JointClass::kHead;
  put(dir, "a", labels);
  CHECK_THROWS_WITH(ensureEveryClass("set", readLabelledSet(dir.path())),
                    "set: no candidate is labelled \"hand\"; each of the four classes is needed to train");

  labels.candidates.clear();
  labels.labels.clear();
  put(dir, "a", labels);
  CHECK(complaint(dir) == ": no candidate has a class");

  put(dir, "a", fourClasses("a.png"));
  LabelFile smaller = fourClasses("b.png");
  smaller.grid_height = 96;
  put(dir, "b", smaller);
  const std::string mixed = "/b.labels.json: grid: the long side is 100 px, in " + dir.file("a.labels.json") +
                            " it is 128 px; label one of them anew";
  CHECK(complaint(dir) == mixed);
  CHECK(checkLabelFolder(dir.path()) == std::vector<std::string>{dir.path() + mixed});

  put(dir, "b", fourClasses("b.png"));
  writeFile(dir.file("b.png"), "another picture");
  CHECK(complaint(dir) ==
        "/b.labels.json: image.file: \"b.png\" has changed since it was labelled; label it anew");
}

TEST_CASE("annotated pictures of both layouts are found and labelled") {
  const TempDir dir;
  writeFile(dir.file("man.png"), encodePng(blockMan()));
  writeFile(dir.file("man.mask.png"), encodePng(blockMan()));
  writeFile(dir.file("man.joints.json"), kBlockManJoints);
  writeFile(dir.file("set/7/image.png"), encodePng(blockMan()));
  writeFile(dir.file("set/7/mask.png"), encodePng(blockMan()));
  writeFile(dir.file("set/7/joints.json"), kBlockManJoints);
  const auto found = findAnnotatedImages(dir.path());
  REQUIRE(found.size() == 2);
  CHECK(found[0].image == dir.file("man.png"));
  CHECK(found[0].mask == dir.file("man.mask.png"));
  CHECK(found[1].image == dir.file("set/7/image.png"));

  const LabelFile labels =
      labelImage(found[0].image, found[0].mask, readJointsFile(found[0].joints), loadTemplate("biped"));
  CHECK(labels.gridSize() == kWorkingGridSize);
  CHECK(labels.image.sha256 == sha256(readFile(found[0].image)));
  CHECK(labels.joints.size() == 14);
  writeLabelFile(labelFileFor(found[0].image), labels);
  const LabelledSet from_file = readLabelledSet(dir.path());
  const LabelledSet from_joints = labelAnnotatedImages(dir.path());
  REQUIRE(from_joints.characters.size() == 2);
  CHECK(from_file.characters[0].labels == from_joints.characters[0].labels);
  CHECK(from_file.characters[0].features == from_joints.characters[0].features);
  CHECK(labelAnnotatedImages(dir.path(), {CandidateMethod::kDiscs}).sampleCount() >
        from_joints.sampleCount());
}

TEST_CASE("label files with placed joints were no pictures with joints to candidates of other methods") {
  const TempDir dir;
  writeFile(dir.file("man.png"), encodePng(blockMan()));
  writeFile(dir.file("man.mask.png"), encodePng(blockMan()));
  const std::string joints_file = dir.file("man.joints.json"), label_file = dir.file("man.labels.json");
  writeFile(joints_file, kBlockManJoints);
  const LabelledSet of_joints = labelAnnotatedImages(dir.path(), {CandidateMethod::kDiscs});
  LabelFile labels = labelImage(dir.file("man.png"), dir.file("man.mask.png"), readJointsFile(joints_file),
                                loadTemplate("biped"));
  std::filesystem::remove(joints_file);
  writeLabelFile(label_file, labels);
  const LabelledSet of_labels = labelAnnotatedImages(dir.path(), {CandidateMethod::kDiscs});
  REQUIRE(of_labels.characters.size() == 1);
  CHECK(of_labels.characters[0].name == "man.png");
  CHECK(of_labels.characters[0].labels == of_joints.characters[0].labels);
  CHECK(of_labels.sha256 == of_joints.sha256);
  // A mask beside a label file that names none counts.
  labels.mask.reset();
  writeLabelFile(label_file, labels);
  CHECK(labelAnnotatedImages(dir.path(), {CandidateMethod::kDiscs}).sha256 == of_joints.sha256);

  // What may belong to a hand that nobody has placed is left out.
  labels.recognized = {"left_hand"};
  writeLabelFile(label_file, labels);
  const LabelledSet without_hand = labelAnnotatedImages(dir.path(), {CandidateMethod::kDiscs});
  CHECK(without_hand.sampleCount() < of_joints.sampleCount());
  CHECK(without_hand.sampleCount() > of_joints.sampleCount() / 2);
  CHECK(without_hand.characters[0].features.rows() == without_hand.sampleCount());
}

TEST_CASE("joints had no image beside them where its ending is in capitals") {
  const TempDir dir;
  const auto picture = GENERATE("man.PNG", "man.Png", "man.JPG", "man.TIFF");
  writeFile(dir.file(picture), encodePng(blockMan()));
  writeFile(dir.file("man.joints.json"), kBlockManJoints);
  writeFile(dir.file("manner.png"), encodePng(blockMan()));
  CHECK(imageOfJointsFile(dir.file("man.joints.json")) == dir.file(picture));
  writeFile(dir.file("man.bmp"), encodePng(blockMan()));
  CHECK(imageOfJointsFile(dir.file("man.joints.json")) == dir.file("man.bmp"));
}

TEST_CASE("one joints file without its picture left no drawing to be measured") {
  const TempDir dir;
  writeFile(dir.file("man.png"), encodePng(blockMan()));
  writeFile(dir.file("man.joints.json"), kBlockManJoints);
  writeFile(dir.file("away.joints.json"), kBlockManJoints);
  std::vector<std::string> left_out;
  const LabelledSet set = labelAnnotatedImages(
      dir.path(), {}, [&](const InputError& error) { left_out.push_back(error.what()); });
  CHECK(set.characters.size() == 1);
  CHECK(left_out ==
        std::vector<std::string>{dir.file("away.joints.json") + ": has no image beside it, away.png"});
}

TEST_CASE("annotated pictures that cannot be used are refused") {
  const TempDir dir;
  CHECK_THROWS_WITH(labelAnnotatedImages(dir.path()),
                    dir.path() +
                        ": holds no pictures with joints (*.joints.json, or *.labels.json of which a person "
                        "has placed a joint)");
  writeFile(dir.file("man.joints.json"), kBlockManJoints);
  CHECK_THROWS_WITH(findAnnotatedImages(dir.path()),
                    dir.file("man.joints.json") + ": has no image beside it, man.png");
  writeFile(dir.file("man.joints.json"), R"({"joints": {"head": [1]}})");
  CHECK_THROWS_WITH(readJointsFile(dir.file("man.joints.json")),
                    dir.file("man.joints.json") + ": joints.head: has 1 numbers, must have 2");
  writeFile(dir.file("man.joints.json"), R"({"joints": {"head": [1, -1e308]}})");
  CHECK_THROWS_WITH(readJointsFile(dir.file("man.joints.json")),
                    dir.file("man.joints.json") + ": joints.head: lies in no picture");
  writeFile(dir.file("blank.png"), encodePng(Plane8(Plane8::Zero(50, 50))));
  CHECK_THROWS_AS(labelImage(dir.file("blank.png"), dir.file("blank.png"), {}, loadTemplate("biped")),
                  InputError);
}

TEST_CASE("a mask of another size than its picture is refused") {
  const TempDir dir;
  writeFile(dir.file("man.png"), encodePng(blockMan()));
  writeFile(dir.file("man.mask.png"), encodePng(Plane8(blockMan().transpose())));
  writeFile(dir.file("man.joints.json"), kBlockManJoints);
  const std::string line =
      dir.file("man.mask.png") +
      ": has 200x160 px, its drawing has 160x200; give both the same size or remove the mask";
  CHECK_THROWS_WITH(labelImage(dir.file("man.png"), dir.file("man.mask.png"), {}, loadTemplate("biped")),
                    line);
  CHECK_THROWS_WITH(labelAnnotatedImages(dir.path()), line);
}

TEST_CASE("annotated pictures in folders and files whose names are not UTF-8 are labelled") {
  const TempDir dir;
  for (const char* name : {"h\xe9ros", "h\xe8ros"}) {
    writeFile(dir.file(std::string("\xff/") + name + ".png"), encodePng(blockMan()));
    writeFile(dir.file(std::string("\xff/") + name + ".joints.json"), kBlockManJoints);
  }
  const LabelledSet set = labelAnnotatedImages(dir.path());
  REQUIRE(set.characters.size() == 2);
  CHECK(set.characters[0].name == "\xff/h\xe8ros.png");
}

TEST_CASE("a folder that may not be read is named") {
  const TempDir dir;
  put(dir, "a", fourClasses("a.png"));
  put(dir, "locked/b", fourClasses("b.png"));
  const LockedFolder locked(dir, "locked");
  const std::string line = dir.file("locked") + ": cannot be read: Permission denied";
  CHECK_THROWS_WITH(readLabelledSet(dir.path()), line);
  CHECK_THROWS_WITH(checkLabelFolder(dir.path()), line);
  CHECK_THROWS_WITH(labelAnnotatedImages(dir.path()), line);
}

TEST_CASE("torso and body, or hip and pelvis, are one joint: ours counts unless it is open") {
  const TempDir dir;
  const auto read = [&](const std::string& joints) {
    writeFile(dir.file("x.joints.json"), R"({"joints": {)" + joints + "}}");
    return readJointsFile(dir.file("x.joints.json"));
  };
  for (const std::string text : {R"("torso": [1, 2], "body": [3, 4])", R"("body": [3, 4], "torso": [1, 2])",
                                 R"("body": null, "torso": [3, 4])", R"("torso": [3, 4], "body": null)",
                                 R"("torso": null, "body": [3, 4])"}) {
    CAPTURE(text);
    const NamedJoints joints = read(text);
    REQUIRE(joints.size() == 1);
    CHECK(joints[0].first == "body");
    REQUIRE(joints[0].second);
    CHECK(*joints[0].second == Eigen::Vector2d(3, 4));
  }
  CHECK(read(R"("hip": [1, 2], "pelvis": [3, 4])").size() == 1);
}
