#include "libskel/export/formats.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "libskel/animation/bvh.h"
#include "libskel/animation/clip_library.h"
#include "libskel/animation/retarget.h"
#include "libskel/animation/sample_pose.h"
#include "libskel/core/error.h"
#include "libskel/image/read_image.h"
#include "tests/support/catch.h"
#include "tests/support/figure.h"

using namespace skel;

namespace {

struct Fixture {
  RiggedCharacter character = figure();
  std::vector<Clip> clips = {retargetToRest(clipNamed(builtinClips(), "wave"), character.skeleton)};
  Image drawing{600, 560};
  Plane8 mask = Plane8::Zero(560, 600);
  ExportInput input{character, clips, {"bob"}, &drawing, &mask};

  Fixture() {
    drawing.rgba.setConstant(200);
    drawing.rgba.col(3) = 255;
    mask.block(20, 150, 520, 300) = 255;
  }
};

std::map<std::string, std::string> bySuffix(const std::vector<ExportedFile>& files) {
  std::map<std::string, std::string> result;
  for (const ExportedFile& file : files) result[file.suffix] = file.bytes;
  REQUIRE(result.size() == files.size());
  return result;
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> result;
  for (std::string word; stream >> word;) result.push_back(word);
  return result;
}

}  // namespace

TEST_CASE("every format writes files of its own, the same bytes each time") {
  const Fixture fixture;
  std::map<std::string, std::string> all;
  for (const ExportFormat& format : exportFormats()) {
    CAPTURE(std::string(format.name));
    CHECK(&exportFormat(format.name) == &format);
    const auto files = bySuffix(format.encode(fixture.input));
    CHECK_FALSE(files.empty());
    CHECK(files == bySuffix(format.encode(fixture.input)));
    const std::vector<std::string> told = format.suffixes("bob", fixture.clips);
    for (const auto& [suffix, bytes] : files) {
      CHECK(std::find(told.begin(), told.end(), suffix) != told.end());
      CHECK_FALSE(bytes.empty());
      CHECK(all.emplace(suffix, bytes).second);
    }
  }
  CHECK_THROWS_WITH(exportFormat("fbx"),
                    "there is no format \"fbx\"; there are: glb, obj, weights, bvh, char_cfg");
}

TEST_CASE("every format writes a character without texture and clips") {
  Fixture fixture;
  fixture.character.mesh.texture = Image();
  fixture.character.mesh.uv.resize(0, 2);
  fixture.clips.clear();
  for (const ExportFormat& format : exportFormats()) CHECK_FALSE(format.encode(fixture.input).empty());
}

TEST_CASE("two clips whose names come to one name of a file are two files") {
  Fixture fixture;
  fixture.clips = {fixture.clips[0], fixture.clips[0], fixture.clips[0]};
  fixture.clips[0].name = "a/b";
  fixture.clips[1].name = "a_b";
  fixture.clips[2].name = "../a";
  const auto files = bySuffix(exportBvh(fixture.input));
  CHECK(files.contains("-a_b.bvh"));
  CHECK(files.contains("-a_b-2.bvh"));
  CHECK(files.contains("-_._a.bvh"));
}

TEST_CASE(
    "an OBJ of a drawing named with # or backslash is refused, one with a blank or a dash before it is not") {
  Fixture fixture;
  for (const std::string stem : {"a#b", "a\\b", "a\nb", "a\rb"}) {
    fixture.input.options.name = stem;
    CHECK_THROWS_AS(exportObj(fixture.input), UsageError);
    CHECK_THROWS_AS(objSuffixes(stem, {}), UsageError);
  }
  for (const std::string stem : {" a", "-a"}) {
    fixture.input.options.name = stem;
    CHECK(bySuffix(exportObj(fixture.input)).at(".obj").find("mtllib ./" + stem + ".mtl\n") !=
          std::string::npos);
  }
}

TEST_CASE("an OBJ holds the mesh, and names its material and texture by the stem") {
  const Fixture fixture;
  const TriangleMesh& mesh = fixture.character.mesh;
  const auto files = bySuffix(exportObj(fixture.input));
  CHECK(files.at(".obj").find("mtllib bob.mtl\n") != std::string::npos);
  CHECK(files.at(".mtl").find("map_Kd bob.png\n") != std::string::npos);
  CHECK((decodeImage(files.at(".png"), "bob.png").rgba == mesh.texture.rgba).all());
  std::istringstream lines(files.at(".obj"));
  std::map<std::string, Eigen::Index> count;
  double error = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::string keyword;
    fields >> keyword;
    const Eigen::Index row = count[keyword]++;
    double x = 0, y = 0, z = 0;
    if (keyword == "v") {
      fields >> x >> y >> z;
      error = std::max(error, (Eigen::RowVector3d(x, y, z) - mesh.vertices.row(row).cast<double>()).norm());
    } else if (keyword == "vt") {
      fields >> x >> y;
      error = std::max(error, (Eigen::RowVector2d(x, 1 - y) - mesh.uv.row(row).cast<double>()).norm());
    } else if (keyword == "f") {
      for (int k = 0; k < 3; ++k) {
        const std::string index = std::to_string(mesh.triangles(row, k) + 1);
        std::string corner;
        fields >> corner;
        REQUIRE(corner == index + "/" + index + "/" + index);
      }
    }
  }
  CHECK(error < 2e-6);
  CHECK(count["v"] == mesh.vertices.rows());
  CHECK(count["vt"] == mesh.vertices.rows());
  CHECK(count["vn"] == mesh.vertices.rows());
  CHECK(count["f"] == mesh.triangles.rows());
}

TEST_CASE("weights name their joints and sum to one") {
  Fixture fixture;
  fixture.input.options.naming = JointNaming::kVrm;
  const auto document = nlohmann::json::parse(bySuffix(exportWeights(fixture.input)).at(".weights.json"));
  CHECK(document["format"] == "skel-skin");
  CHECK(document["version"] == 1);
  CHECK(document["joints"][0] == "hips");
  REQUIRE(document["vertices"].size() == std::size_t(fixture.character.mesh.vertices.rows()));
  for (const auto& vertex : document["vertices"]) {
    double sum = 0;
    for (const double weight : vertex["weights"]) sum += weight;
    REQUIRE(sum == Approx(1).margin(3e-6));
    REQUIRE(vertex["joints"].size() == vertex["weights"].size());
  }
}

TEST_CASE("a BVH holds the tree in centimetres and the clip in degrees") {
  const Fixture fixture;
  const Skeleton& skeleton = fixture.character.skeleton;
  const std::vector<std::string> text =
      words(bySuffix(exportBvh(fixture.input)).at("-" + fixture.clips.front().name + ".bvh"));
  // Reads it as a program would: offsets add up to the joints' positions.
  std::vector<Eigen::Vector3d> open;
  std::vector<std::string> order;
  std::map<std::string, Eigen::Vector3d> at;
  std::size_t i = 1, channels = 0;
  bool named = false;
  for (; text[i] != "MOTION"; ++i) {
    if (text[i] == "ROOT" || text[i] == "JOINT")
      order.push_back(text[++i]), named = true;
    else if (text[i] == "End")
      named = false;
    else if (text[i] == "OFFSET") {
      const Eigen::Vector3d offset(std::stod(text[i + 1]), std::stod(text[i + 2]), std::stod(text[i + 3]));
      open.push_back(open.empty() ? offset : Eigen::Vector3d(open.back() + offset));
      if (named) at[order.back()] = open.back();
    } else if (text[i] == "CHANNELS")
      channels += std::stoul(text[i + 1]);
    else if (text[i] == "}")
      open.pop_back();
  }
  CHECK(open.empty());
  CHECK(order.size() == skeleton.joints.size());
  CHECK(channels == 3 * skeleton.joints.size() + 3);
  for (const Joint& joint : skeleton.joints)
    CHECK((at.at(joint.name) - 100 * (joint.position - skeleton.joints[0].position)).norm() < 0.01);

  REQUIRE(text[i + 1] == "Frames:");
  const std::size_t frames = std::stoul(text[i + 2]);
  CHECK(frames == 91);
  CHECK(std::stod(text[i + 5]) == Approx(1.0 / 30));
  const std::size_t first = i + 6;
  REQUIRE(text.size() == first + frames * channels);
  CHECK(std::stod(text[first + 1]) == Approx(100 * skeleton.joints[0].position.y()));
  // Rz · Rx · Ry of the elbow in frame 30 is the clip's rotation at one second.
  const std::size_t elbow = std::size_t(std::find(order.begin(), order.end(), "right_elbow") - order.begin());
  const auto degrees = [&](std::size_t k) {
    return std::stod(text[first + 30 * channels + 3 + 3 * elbow + k]) * 0.0174532925;
  };
  const Eigen::Quaterniond q = Eigen::AngleAxisd(degrees(0), Eigen::Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(degrees(1), Eigen::Vector3d::UnitX()) *
                               Eigen::AngleAxisd(degrees(2), Eigen::Vector3d::UnitY());
  const Pose pose = samplePose(fixture.clips[0], skeleton, 1);
  CHECK(q.angularDistance(pose.rotations[skeleton.index("right_elbow")].cast<double>()) < 1e-3);
}

TEST_CASE(
    "joints whose names would break the lines of a BVH get others, all different, and it is read again") {
  Fixture fixture;
  const std::vector<std::string> odd = {"a\nJOINT b\n{", " a", "a ", "", "a{", "a_", "a\t{", "\x7f", "_"};
  for (std::size_t j = 0; j < odd.size(); ++j) fixture.character.skeleton.joints[j].name = odd[j];
  fixture.clips.clear();
  const ExportInput input{fixture.character, fixture.clips, {"hero"}};
  const BvhMotion motion = parseBvh(bySuffix(exportBvh(input)).at(".bvh"), "a.bvh");
  REQUIRE(motion.skeleton.joints.size() == fixture.character.skeleton.joints.size());
  std::set<std::string> names;
  for (const Joint& joint : motion.skeleton.joints) names.insert(joint.name);
  CHECK(names.size() == motion.skeleton.joints.size());
  CHECK(names.contains("a_"));
  CHECK(names.contains("a_JOINT b_{_"));
}

TEST_CASE("a character folder for AnimatedDrawings holds sixteen joints in the crop's pixels") {
  Fixture fixture;
  const auto files = bySuffix(exportCharCfg(fixture.input));
  const Image texture = decodeImage(files.at("/texture.png"), "texture.png");
  const Image mask = decodeImage(files.at("/mask.png"), "mask.png");
  CHECK(texture.width == 308);
  CHECK(texture.height == 528);
  CHECK(mask.width == texture.width);
  CHECK(mask.height == texture.height);
  CHECK(texture.pixel(0, 0)[3] == 0);
  CHECK(texture.pixel(4, 4)[3] == 255);
  CHECK(mask.pixel(3, 4)[0] == 0);
  CHECK(mask.pixel(4, 4)[0] == 255);
  // Its reader wants four channels.
  CHECK(files.at("/texture.png")[25] == 6);

  const std::string& yaml = files.at("/char_cfg.yaml");
  CHECK(yaml.starts_with("height: 528\nskeleton:\n- loc:\n"));
  CHECK(yaml.ends_with("width: 308\n"));
  std::size_t joints = 0;
  for (std::size_t at = 0; (at = yaml.find("- loc:", at)) != std::string::npos; ++at) ++joints;
  CHECK(joints == 16);
  const Eigen::Vector2d head =
      fixture.character.skeleton.joints[fixture.character.skeleton.index("head")].image;
  const std::string neck = "- loc:\n  - " + std::to_string(std::lround(head.x() - 146)) + "\n  - " +
                           std::to_string(std::lround(head.y() - 16)) + "\n  name: neck\n  parent: torso\n";
  CHECK(yaml.find(neck) != std::string::npos);
  CHECK(yaml.find("name: root\n  parent: null\n") != std::string::npos);

  fixture.mask.setConstant(255);  // a figure that fills the picture
  CHECK(bySuffix(exportCharCfg(fixture.input)).at("/texture.png")[25] == 6);
  fixture.input.mask = nullptr;
  CHECK_THROWS_AS(exportCharCfg(fixture.input), UsageError);
}

TEST_CASE("a chain of 30000 joints becomes a BVH without depth or size running away") {
  RiggedCharacter character = figure();
  std::vector<Joint>& joints = character.skeleton.joints;
  for (int i = 0; i < 30'000; ++i) {
    Joint joint;
    joint.name = "link" + std::to_string(i);
    joint.parent = static_cast<int>(joints.size()) - 1;
    joint.position = joints.back().position + Eigen::Vector3d(0, .01, 0);
    joints.push_back(joint);
  }
  const std::string text = exportBvh({character, {}, {"chain"}})[0].bytes;
  CHECK(text.size() < 40'000'000);
  CHECK(std::count(text.begin(), text.end(), '{') == std::count(text.begin(), text.end(), '}'));
  CHECK(text.find("JOINT link29999\n") != std::string::npos);
}
