// Annotations of other programs: read, written, read again.
#include <filesystem>

#include "labeler/annotated_drawing.h"
#include "labeler/char_cfg.h"
#include "labeler/mask_brush.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/json.h"
#include "libskel/export/formats.h"
#include "libskel/image/write_image.h"
#include "tests/labeler/drawing_folder.h"
#include "tests/support/catch.h"
#include "tests/support/locked_folder.h"

using namespace skel;
namespace fs = std::filesystem;

namespace {

// As yaml.dump writes it, and as people do.
const std::string kCharCfg = R"(height: 600
skeleton:
- loc:
  - 300
  - 400
  name: root
  parent: null
- loc: [300.5, 250]
  name: "torso"   # between the shoulders
  parent: root
- loc: [302, 120]
  name: neck
  parent: torso
- {NAMES}
width: 600
)";

std::string charCfg() {
  std::string limbs;
  for (const char* side : {"left", "right"}) {
    int y = 240;
    for (const char* joint : {"shoulder", "elbow", "hand", "hip", "knee", "foot"})
      limbs += std::string(limbs.empty() ? "" : "- ") + "loc:\n  - " + (side[0] == 'l' ? "340" : "260") +
               "\n  - " + std::to_string(y += 40) + "\n  name: " + side + "_" + joint + "\n  parent: torso\n";
  }
  std::string text = kCharCfg;
  return text.replace(text.find("{NAMES}\n"), 8, limbs);
}

Eigen::Vector2d place(const NamedJoints& joints, const std::string& name) {
  for (const auto& [joint, point] : joints)
    if (joint == name && point) return *point;
  FAIL("no " << name);
  return {};
}

std::string problemOf(const std::string& yaml) {
  try {
    parseCharCfg(yaml, "char_cfg.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("char_cfg.yaml: lists in both spellings, quotes and comments") {
  const CharCfg cfg = parseCharCfg(charCfg(), "char_cfg.yaml");
  CHECK(cfg.width == 600);
  CHECK(cfg.height == 600);
  REQUIRE(cfg.joints.size() == 15);
  CHECK(cfg.joints[0].first == "root");
  CHECK(cfg.joints[0].second == Eigen::Vector2d(300, 400));
  CHECK(cfg.joints[1].first == "torso");
  CHECK(cfg.joints[1].second == Eigen::Vector2d(300.5, 250));
}

TEST_CASE("char_cfg.yaml: what is wrong is said with its line") {
  CHECK(problemOf("width: 3\nheight: 4\n") == "char_cfg.yaml: has no skeleton");
  CHECK(problemOf("width: 3\nheight: x\n") == "char_cfg.yaml: line 2: expected a number, found 'x'");
  CHECK(problemOf("width: 0\n") == "char_cfg.yaml: line 1: expected a size in px");
  CHECK(problemOf("nonsense\n") == "char_cfg.yaml: line 1: expected 'key: value'");
  CHECK(problemOf("colour: red\n") == "char_cfg.yaml: line 1: unknown key 'colour'");
  CHECK(problemOf("skeleton:\n- loc: [1 2]\n  name: a\n") == "char_cfg.yaml: line 2: loc needs two numbers");
  CHECK(problemOf("skeleton:\n- loc:\n  - 1\n  name: a\n") == "char_cfg.yaml: line 3: loc needs two numbers");
  CHECK(problemOf("skeleton:\n- name: a\n  parent: null\n") ==
        "char_cfg.yaml: line 3: a joint needs loc and name");
  CHECK(problemOf("skeleton:\n- 7\n") == "char_cfg.yaml: line 2: expected loc, name and parent of a joint");
  CHECK(problemOf("") == "char_cfg.yaml: width and height are missing");
}

// Each name was held against all before it.
TEST_CASE("char_cfg.yaml: a joint is there once, and of joints there may be many") {
  constexpr int kJoints = 400'000;
  std::string yaml = "width: 9\nheight: 9\nskeleton:\n";
  for (int j = 0; j < kJoints; ++j) yaml += "- loc: [1, 2]\n  name: j" + std::to_string(j) + "\n";
  CHECK(parseCharCfg(yaml, "char_cfg.yaml").joints.size() == kJoints);
  CHECK(problemOf(yaml + "- loc: [1, 2]\n  name: j7\n") ==
        "char_cfg.yaml: line 800005: the joint 'j7' is there twice");
}

TEST_CASE("all layouts are found at any depth") {
  const SkeletonTemplate plan = loadTemplate("biped");
  const TempDir dir;
  copyCharacter("cap_boy", dir.file("ours"));
  fs::create_directories(dir.file("deep/er/single"));
  fs::copy(kCharacters + "runner.png", dir.file("deep/er/single/image.png"));
  fs::copy(kCharacters + "runner.mask.png", dir.file("deep/er/single/mask.png"));
  fs::copy(kCharacters + "runner.joints.json", dir.file("deep/er/single/joints.json"));
  fs::create_directories(dir.file("meta"));
  fs::copy(kCharacters + "box_robot.png", dir.file("meta/texture.png"));
  fs::copy(kCharacters + "box_robot.mask.png", dir.file("meta/mask.png"));
  writeFile(dir.file("meta/char_cfg.yaml"), charCfg());

  const auto drawings = findAnnotatedDrawings(dir.path(), {plan});
  REQUIRE(drawings.size() == 3);
  CHECK(drawings[0].image == dir.file("deep/er/single/image.png"));
  CHECK(drawings[0].mask == dir.file("deep/er/single/mask.png"));
  CHECK(drawings[1].image == dir.file("meta/texture.png"));
  CHECK(drawings[2].image == dir.file("ours/cap_boy.png"));
  CHECK(drawings[2].joints.size() == 14);
  // Their neck is the face, their torso lies between the shoulders.
  CHECK(place(drawings[1].joints, "head") == Eigen::Vector2d(302, 120));
  CHECK(place(drawings[1].joints, "neck") == Eigen::Vector2d(300.5, 250));
  CHECK(place(drawings[1].joints, "pelvis") == Eigen::Vector2d(300, 400));
  CHECK(place(drawings[1].joints, "left_shoulder") == Eigen::Vector2d(340, 280));
  CHECK(place(drawings[1].joints, "body") == Eigen::Vector2d(300, 340));

  fs::remove(dir.file("meta/mask.png"));
  CHECK_THROWS_WITH(findAnnotatedDrawings(dir.path(), {plan}),
                    dir.file("meta/char_cfg.yaml") + ": needs mask.png beside it");
}

TEST_CASE("char_cfg.yaml of skel-infer: what the program had found came back as placed by a person") {
  const SkeletonTemplate plan = loadTemplate("biped");
  const TempDir dir;
  RiggedCharacter character;
  character.skeleton = presetSkeleton(plan, {20, 10}, {80, 110});
  character.skeleton.joints[static_cast<size_t>(character.skeleton.index("left_hand"))].origin =
      JointOrigin::kEdited;
  const Image drawing(100, 120);
  Plane8 mask = Plane8::Zero(120, 100);
  mask.block(10, 20, 100, 60) = 255;
  const auto write = [&](bool mask_is_given) {
    for (const ExportedFile& file : exportCharCfg({character, {}, {}, &drawing, &mask, mask_is_given}))
      writeFile(dir.file("hero" + file.suffix), file.bytes);
  };
  const auto read = [&] { return findAnnotatedDrawings(dir.path(), {plan}).at(0); };
  const auto is_placed = [](const AnnotatedDrawing& read, const std::string& name) {
    place(read.joints, name);
    return std::find(read.recognized.begin(), read.recognized.end(), name) == read.recognized.end();
  };
  write(false);
  AnnotatedDrawing back = read();
  CHECK_FALSE(back.mask);
  for (const auto& [name, at] : back.joints) CHECK(is_placed(back, name) == (name == "left_hand"));

  const std::string cfg = dir.file("hero/char_cfg.yaml"), mask_file = dir.file("hero/mask.png");
  const Eigen::Vector2d foot = place(back.joints, "left_foot");
  std::string text = readFile(cfg);
  const size_t found = text.find("skel_found:", text.find("name: left_foot"));
  REQUIRE(found != std::string::npos);
  writeFile(cfg, text.insert(found + 13, "1"));  // it was found elsewhere: a person has moved it since
  back = read();
  CHECK(place(back.joints, "left_foot") == foot);
  CHECK(is_placed(back, "left_foot"));
  CHECK_FALSE(is_placed(back, "right_foot"));
  mask.block(10, 20, 5, 5) = 0;
  writeFile(mask_file, encodePng(mask));
  CHECK(read().mask == mask_file);
  write(true);
  CHECK(read().mask == mask_file);
}

TEST_CASE("a folder of annotations that may not be read is named") {
  const TempDir dir;
  copyCharacter("cap_boy", dir.file("a/locked"));
  const LockedFolder locked(dir, "a/locked");
  CHECK_THROWS_WITH(findAnnotatedDrawings(dir.path(), {loadTemplate("biped")}),
                    dir.file("a/locked") + ": cannot be read: Permission denied");
}

TEST_CASE("COCO: people's keypoints under our names") {
  const SkeletonTemplate plan = loadTemplate("biped");
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  fs::remove(dir.file("cap_boy.joints.json"));
  std::string keypoints = "0,0,0, 290,100,2, 310,100,2, 0,0,0, 0,0,0";
  for (int i = 5; i < 17; ++i)
    keypoints += "," + std::to_string(200 + 10 * i) + "," + std::to_string(20 * i) + ",1";
  const auto write = [&](const std::string& annotation) {
    writeFile(
        dir.file("people.json"),
        R"({"images": [{"id": 7, "file_name": "cap_boy.png", "width": 600, "height": 600}], "annotations": [)" +
            annotation + "]}");
  };
  write(R"({"id": 1, "image_id": 7, "keypoints": [)" + keypoints +
        R"(], "bbox": [0, 0, 9, 9], "segmentation": [[10, 10, 30, 10, 30, 30, 10, 30]]})");
  const auto drawings = findAnnotatedDrawings(dir.path(), {plan});
  REQUIRE(drawings.size() == 1);
  CHECK(place(drawings[0].joints, "head") == Eigen::Vector2d(300, 100));
  CHECK(place(drawings[0].joints, "left_hand") == Eigen::Vector2d(290, 180));
  CHECK(place(drawings[0].joints, "right_foot") == Eigen::Vector2d(360, 320));
  CHECK((maskFromPolygons(drawings[0].mask_polygons, 600, 600) != 0).count() == 20 * 20);

  write(R"({"image_id": 8, "keypoints": []})");
  CHECK_THROWS_WITH(readCoco(dir.file("people.json"), {plan}),
                    dir.file("people.json") + ": annotations[0].image_id: is no image of this file");
  write(R"({"image_id": 7, "keypoints": [1, 2, 2]})");
  CHECK_THROWS_WITH(
      readCoco(dir.file("people.json"), {plan}),
      dir.file("people.json") + ": annotations[0].keypoints: expected 17 times x, y, visibility");
  write(R"({"image_id": 7, "keypoints": [)" + keypoints + R"(], "segmentation": {"counts": "abc"}})");
  CHECK_THROWS_WITH(
      readCoco(dir.file("people.json"), {plan}),
      dir.file("people.json") + ": annotations[0].segmentation: run lengths are not read: give polygons");
}

TEST_CASE("COCO that we write is COCO that we read: joints, and the mask to the pixel") {
  const SkeletonTemplate plan = loadTemplate("biped");
  const TempDir dir;
  copyCharacter("cap_boy", dir.path());
  fs::remove(dir.file("cap_boy.joints.json"));
  Plane8 mask = Plane8::Zero(600, 600);
  paintLine(mask, {100, 100}, {400, 300}, 50, 255);
  paintLine(mask, {240, 200}, {260, 210}, 9, 0);  // a hole
  const Silhouette silhouette = silhouetteFromMask(mask);
  const NamedJoints joints = {{"head", Eigen::Vector2d(12.25, 30)}, {"left_hand", std::nullopt}};
  writeFile(dir.file("coco.json"),
            formatCoco({{"cap_boy.png", 600, 600, joints, {}, silhouette.outline}}, {plan}));
  const auto drawings = readCoco(dir.file("coco.json"), {plan});
  REQUIRE(drawings.size() == 1);
  REQUIRE(drawings[0].joints.size() == 1);
  CHECK(place(drawings[0].joints, "head") == Eigen::Vector2d(12.25, 30));
  CHECK((maskFromPolygons(drawings[0].mask_polygons, 600, 600) == silhouette.mask).all());
  const JsonDocument document = JsonDocument::readFile(dir.file("coco.json"));
  CHECK(document.root().at("annotations").items()[0].at("area").asNumber() ==
        static_cast<double>((silhouette.mask != 0).count()));
}

TEST_CASE("COCO: joints that the program has found are no keypoints, and come back as found") {
  const SkeletonTemplate plan = loadTemplate("biped");
  const TempDir dir;
  writeFile(dir.file("boy.png"), encodePng(Image(60, 60)));
  const NamedJoints joints = {{"head", Eigen::Vector2d(12.25, 30)}, {"left_hand", Eigen::Vector2d(40, 20)}};
  const std::string path = dir.file("coco.json");
  writeFile(path, formatCoco({{"boy.png", 60, 60, joints, {"left_hand"}, {}}}, {plan}));
  const JsonDocument document = JsonDocument::readFile(path);
  const JsonValue annotation = document.root().at("annotations").items()[0];
  CHECK(annotation.at("num_keypoints").asNumber() == 1);
  const std::vector<double> keypoints = annotation.at("keypoints").asNumbers();
  const auto at = [&](const std::string& joint) {
    const auto* from = &keypoints[3 * static_cast<size_t>(plan.find(joint))];
    return std::vector<double>(from, from + 3);
  };
  CHECK(at("head") == std::vector<double>{12.25, 30, 2});
  CHECK(at("left_hand") == std::vector<double>{0, 0, 0});

  const auto drawings = readCoco(path, {plan});
  REQUIRE(drawings.size() == 1);
  CHECK(place(drawings[0].joints, "head") == Eigen::Vector2d(12.25, 30));
  CHECK(place(drawings[0].joints, "left_hand") == Eigen::Vector2d(40, 20));
  CHECK(drawings[0].recognized == std::vector<std::string>{"left_hand"});

  std::string text = readFile(path);
  text.replace(text.find("\"left_hand\": ["), 11, "\"head\"");
  writeFile(path, text);
  CHECK_THROWS_WITH(readCoco(path, {plan}),
                    path + ": annotations[0].skel_found.head: is among the keypoints, too");
}

TEST_CASE("a brush is round, leaves no gaps, and may lie outside") {
  Plane8 mask = Plane8::Zero(40, 60);
  CHECK(paintLine(mask, {10, 10}, {50, 30}, 4, 255));
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) {
      const Eigen::Vector2d p(x, y), a(10, 10), d(40, 20);
      const double t = std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
      CHECK((mask(y, x) != 0) == ((p - a - t * d).norm() <= 4));
    }
  CHECK_FALSE(paintLine(mask, {10, 10}, {50, 30}, 4, 255));
  CHECK_FALSE(paintLine(mask, {-100, -100}, {-90, 500}, 4, 255));
  CHECK(paintLine(mask, {-3, 39}, {-3, 39}, 4, 255));
  CHECK(mask(39, 1) == 255);
  Plane8 one = Plane8::Zero(1, 1);
  CHECK(paintLine(one, {0, 0}, {0, 0}, 0, 255));
  Plane8 none(0, 0);
  CHECK_FALSE(paintLine(none, {0, 0}, {1, 1}, 5, 255));
}

TEST_CASE("COCO: places of huge numbers, which became pixels without bounds, are refused") {
  const TempDir dir;
  writeFile(dir.file("a.png"), encodePng(Image(8, 8)));
  const auto complaint = [&](const std::string& segmentation, const std::string& x) {
    writeFile(
        dir.file("coco.json"),
        R"({"images": [{"id": 1, "file_name": "a.png"}], "categories": [{"id": 1, "keypoints": ["nose"]}],)"
        R"("annotations": [{"image_id": 1, "category_id": 1, "keypoints": [)" +
            x + R"(, 1, 2], "segmentation": )" + segmentation + "}]}");
    try {
      readCoco(dir.file("coco.json"), {loadTemplate("biped")});
    } catch (const InputError& error) {
      return error.problem();
    }
    return std::string("none");
  };
  CHECK(complaint("[[0, 0, 8, 0, 8, 8]]", "4") == "none");
  CHECK(complaint("[[-1e308, 1e308, 1e308, -1e308, 0, 1]]", "4") ==
        "annotations[0].segmentation[0]: holds a place that lies in no picture");
  CHECK(complaint("[[0, 0, 8, 0, 8, 8]]", "1e300") ==
        "annotations[0].keypoints: holds a place that lies in no picture");
  std::string long_way = "0, 0";
  for (int i = 0; i < 30; ++i) long_way += ", 1, 900000, 1, 0";
  CHECK(complaint("[[" + long_way + "]]", "4") ==
        "annotations[0].segmentation: outlines no figure: its lines are too long");
}
