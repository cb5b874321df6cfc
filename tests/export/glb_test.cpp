#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "libskel/animation/clip_library.h"
#include "libskel/animation/retarget.h"
#include "libskel/core/error.h"
#include "libskel/export/bone_ends.h"
#include "libskel/export/joint_names.h"
#include "libskel/export/write_character.h"
#include "libskel/mesh/split_seams.h"
#include "tests/support/catch.h"
#include "tests/support/figure.h"

using namespace skel;
using nlohmann::json;

namespace {

// A GLB taken apart by the specification alone.
struct Glb {
  json document;
  std::string buffer;
};

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

Glb parseGlb(const std::string& bytes) {
  REQUIRE(bytes.size() > 28);
  REQUIRE(bytes.substr(0, 4) == "glTF");
  REQUIRE(word(bytes, 4) == 2);
  REQUIRE(word(bytes, 8) == bytes.size());
  const std::size_t json_size = word(bytes, 12);
  REQUIRE(bytes.substr(16, 4) == "JSON");
  REQUIRE(json_size % 4 == 0);
  Glb glb{json::parse(bytes.substr(20, json_size)), {}};
  REQUIRE(bytes.substr(20 + json_size + 4, 3) == "BIN");
  glb.buffer = bytes.substr(28 + json_size);
  REQUIRE(glb.buffer.size() == word(bytes, 20 + json_size));
  REQUIRE(glb.document["buffers"].size() == 1);
  return glb;
}

// The numbers of an accessor, normalised ones in [0, 1].
std::vector<double> numbers(const Glb& glb, int index) {
  const json& accessor = glb.document["accessors"][index];
  const json& view = glb.document["bufferViews"][accessor["bufferView"].get<int>()];
  const std::map<std::string, int> widths = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
  const std::size_t count = accessor["count"].get<std::size_t>() * widths.at(accessor["type"]);
  const int type = accessor["componentType"];
  const std::size_t size = type == 5121 ? 1 : type == 5123 ? 2 : 4;
  const std::size_t begin = view.value("byteOffset", 0) + accessor.value("byteOffset", 0);
  REQUIRE(begin % 4 == 0);
  REQUIRE(count * size == view["byteLength"]);
  REQUIRE(begin + count * size <= glb.buffer.size());
  const double unit = !accessor.value("normalized", false) ? 1 : type == 5121 ? 255 : 65535;
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    const char* at = glb.buffer.data() + begin + i * size;
    float real = 0;
    std::uint32_t whole = 0;
    std::memcpy(&whole, at, size);
    std::memcpy(&real, at, size);
    values.push_back(type == 5126 ? real : whole / unit);
  }
  return values;
}

Eigen::Affine3d restTransform(const json& nodes, const std::vector<int>& parents, int node) {
  Eigen::Affine3d global = Eigen::Affine3d::Identity();
  for (; node >= 0; node = parents[node]) {
    const auto t = nodes[node]["translation"].get<std::vector<double>>();
    Eigen::Affine3d local(Eigen::Translation3d(t[0], t[1], t[2]));
    if (nodes[node].contains("rotation")) {
      const auto r = nodes[node]["rotation"].get<std::vector<double>>();
      local.rotate(Eigen::Quaterniond(r[3], r[0], r[1], r[2]));
    }
    global = local * global;
  }
  return global;
}

std::vector<int> parentsOf(const json& nodes) {
  std::vector<int> parents(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const int child : nodes[i].value("children", std::vector<int>())) parents[child] = int(i);
  return parents;
}

// What an accessor of times and one of values say of a time; quaternions are turned the short way.
Eigen::VectorXd sampled(const Glb& glb, const json& sampler, double time_s) {
  const std::vector<double> times = numbers(glb, sampler["input"]), values = numbers(glb, sampler["output"]);
  const Eigen::Index width = Eigen::Index(values.size() / times.size());
  const auto at = [&](std::size_t i) -> Eigen::VectorXd {
    return Eigen::Map<const Eigen::VectorXd>(values.data() + Eigen::Index(i) * width, width);
  };
  const std::size_t next = std::size_t(std::upper_bound(times.begin(), times.end(), time_s) - times.begin());
  if (next == 0) return at(0);
  if (next == times.size()) return at(next - 1);
  const double t = (time_s - times[next - 1]) / (times[next] - times[next - 1]);
  if (width == 3) return (1 - t) * at(next - 1) + t * at(next);
  const Eigen::Quaterniond from(Eigen::Vector4d(at(next - 1))), to(Eigen::Vector4d(at(next)));
  return from.slerp(t, to).coeffs();
}

// The vertices in an animation's pose, by the specification alone.
Eigen::MatrixX3d posed(const Glb& glb, const json& animation, double time_s) {
  const json& nodes = glb.document["nodes"];
  struct Place {
    Eigen::Vector3d translation = Eigen::Vector3d::Zero(), scale = Eigen::Vector3d::Ones();
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  };
  std::vector<Place> places(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto t = nodes[i].value("translation", std::vector<double>{0, 0, 0});
    const auto r = nodes[i].value("rotation", std::vector<double>{0, 0, 0, 1});
    places[i].translation = {t[0], t[1], t[2]};
    places[i].rotation = Eigen::Quaterniond(r[3], r[0], r[1], r[2]);
  }
  for (const json& channel : animation["channels"]) {
    Place& place = places[channel["target"]["node"].get<std::size_t>()];
    const Eigen::VectorXd value = sampled(glb, animation["samplers"][channel["sampler"].get<int>()], time_s);
    const std::string path = channel["target"]["path"];
    if (path == "rotation") place.rotation = Eigen::Quaterniond(Eigen::Vector4d(value));
    if (path == "translation") place.translation = value;
    if (path == "scale") place.scale = value;
  }
  const std::vector<int> parents = parentsOf(nodes);
  const json& skin = glb.document["skins"][0];
  const std::vector<double> inverse_bind = numbers(glb, skin["inverseBindMatrices"]);
  std::vector<Eigen::Matrix4d> matrices;
  for (const int joint : skin["joints"].get<std::vector<int>>()) {
    Eigen::Affine3d global = Eigen::Affine3d::Identity();
    for (int node = joint; node >= 0; node = parents[node])
      global = Eigen::Translation3d(places[node].translation) * places[node].rotation *
               Eigen::Scaling(places[node].scale) * global;
    const Eigen::Index at = 16 * Eigen::Index(matrices.size());
    matrices.push_back(global.matrix() * Eigen::Map<const Eigen::Matrix4d>(inverse_bind.data() + at));
  }
  const json& attributes = glb.document["meshes"][0]["primitives"][0]["attributes"];
  const std::vector<double> positions = numbers(glb, attributes["POSITION"]),
                            joints = numbers(glb, attributes["JOINTS_0"]),
                            weights = numbers(glb, attributes["WEIGHTS_0"]);
  Eigen::MatrixX3d result = Eigen::MatrixX3d::Zero(Eigen::Index(positions.size() / 3), 3);
  for (Eigen::Index v = 0; v < result.rows(); ++v) {
    const Eigen::Vector4d here(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2], 1);
    for (Eigen::Index k = 4 * v; k < 4 * v + 4; ++k)
      result.row(v) += weights[k] * (matrices[std::size_t(joints[k])] * here).head<3>().transpose();
  }
  return result;
}

// What must hold for every GLB that skel writes.
void checkStructure(const Glb& glb, const RiggedCharacter& character) {
  const json& document = glb.document;
  CHECK(document["asset"]["generator"] == "skel");
  const json& nodes = document["nodes"];
  std::set<std::string> names;
  for (const json& node : nodes) names.insert(node["name"].get<std::string>());
  CHECK(names.size() == nodes.size());

  // One tree of joints beside the mesh.
  const json& skin = document["skins"][0];
  std::vector<int> parents(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const int child : nodes[i].value("children", std::vector<int>())) {
      CHECK(parents[child] == -1);
      parents[child] = int(i);
    }
  REQUIRE(skin["joints"].size() == character.skeleton.joints.size());
  int roots = 0;
  for (const int joint : skin["joints"].get<std::vector<int>>()) roots += parents[joint] < 0;
  CHECK(roots == 1);
  CHECK(document["scenes"][0]["nodes"].size() == 2);

  // Inverse bind matrix times global rest transform is the identity, and the joint's +y runs along its bone.
  const std::vector<double> inverse_bind = numbers(glb, skin["inverseBindMatrices"]);
  const double ground = character.mesh.vertices.col(1).minCoeff();
  for (std::size_t j = 0; j < skin["joints"].size(); ++j) {
    const Eigen::Affine3d global = restTransform(nodes, parents, skin["joints"][j]);
    const Joint& joint = character.skeleton.joints[j];
    CHECK((global.translation() - joint.position).norm() < 1e-5);
    const Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix4d>(inverse_bind.data() + 16 * j);
    CHECK((matrix * global.matrix() - Eigen::Matrix4d::Identity()).norm() < 1e-6);
    int child = -1, children = 0;
    for (std::size_t k = 0; k < skin["joints"].size(); ++k) {
      if (character.skeleton.joints[k].parent != int(j)) continue;
      child = int(k);
      ++children;
    }
    if (global.linear().isIdentity(1e-12)) continue;  // a clip stretches it
    const Eigen::Vector3d y = global.linear().col(1);
    if (children == 1) {
      CHECK(y.dot((character.skeleton.joints[child].position - joint.position).normalized()) > .9999);
    } else if (children == 0) {
      const double length = (joint.position - character.skeleton.joints[joint.parent].position).norm();
      CHECK((joint.position + length * y).y() > ground - 1e-6);
    }
  }

  const json& primitive = document["meshes"][0]["primitives"][0];
  const json& attributes = primitive["attributes"];
  const std::size_t count = std::size_t(character.mesh.vertices.rows());
  for (const auto& [name, accessor] : attributes.items())
    CHECK(document["accessors"][accessor.get<int>()]["count"] == count);
  for (const double index : numbers(glb, primitive["indices"])) REQUIRE(index < double(count));
  const std::vector<double> positions = numbers(glb, attributes["POSITION"]);
  for (int k = 0; k < 3; ++k) {
    double low = 1e9, high = -1e9;
    for (std::size_t i = k; i < positions.size(); i += 3)
      low = std::min(low, positions[i]), high = std::max(high, positions[i]);
    CHECK(document["accessors"][attributes["POSITION"].get<int>()]["min"][k] == low);
    CHECK(document["accessors"][attributes["POSITION"].get<int>()]["max"][k] == high);
  }
  const std::vector<double> normals = numbers(glb, attributes["NORMAL"]);
  for (std::size_t i = 0; i < count; ++i)
    REQUIRE(Eigen::Map<const Eigen::Vector3d>(&normals[3 * i]).norm() == Approx(1).margin(1e-5));
  const std::vector<double> joints = numbers(glb, attributes["JOINTS_0"]);
  const std::vector<double> weights = numbers(glb, attributes["WEIGHTS_0"]);
  for (std::size_t i = 0; i < count; ++i) {
    double sum = 0;
    for (std::size_t k = 4 * i; k < 4 * i + 4; ++k) {
      REQUIRE(joints[k] < double(character.skeleton.joints.size()));
      if (weights[k] == 0) REQUIRE(joints[k] == 0);
      REQUIRE(std::abs(weights[k] - character.weights.weights(Eigen::Index(i), Eigen::Index(k - 4 * i))) <
              3e-5);
      sum += weights[k];
    }
    REQUIRE(sum == Approx(1).margin(1e-9));
  }
}

}  // namespace

TEST_CASE("a GLB holds the mesh, its skin, its texture and its clips") {
  const RiggedCharacter character = figure();
  const Clip wave = retargetToRest(clipNamed(builtinClips(), "wave"), character.skeleton);
  const std::string bytes = encodeGlb(character, {wave}, {"figure"});
  const Glb glb = parseGlb(bytes);
  checkStructure(glb, character);

  CHECK(glb.document["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] == 0);
  // A share of the texture shines, so that no light turns white paper grey; together they are the texture.
  const json& material = glb.document["materials"][0];
  CHECK(material["emissiveTexture"]["index"] ==
        material["pbrMetallicRoughness"]["baseColorTexture"]["index"]);
  for (int k = 0; k < 3; ++k)
    CHECK(material["emissiveFactor"][k].get<double>() +
              material["pbrMetallicRoughness"]["baseColorFactor"][k].get<double>() ==
          Approx(1));
  CHECK(glb.document["images"][0]["mimeType"] == "image/png");
  const json& view = glb.document["bufferViews"][glb.document["images"][0]["bufferView"].get<int>()];
  CHECK(glb.buffer.substr(view.value("byteOffset", 0) + 1, 3) == "PNG");

  REQUIRE(glb.document["animations"].size() == 1);
  const json& animation = glb.document["animations"][0];
  CHECK(animation["name"] == "wave");
  CHECK(animation["channels"].size() == wave.tracks.size());
  for (const json& channel : animation["channels"]) {
    CHECK(channel["target"]["path"] == "rotation");
    const json& sampler = animation["samplers"][channel["sampler"].get<int>()];
    const std::vector<double> times = numbers(glb, sampler["input"]);
    CHECK(times.front() == 0);
    CHECK(times.back() == Approx(wave.duration_s()));
    CHECK(numbers(glb, sampler["output"]).size() == 4 * times.size());
  }
  CHECK(bytes == encodeGlb(character, {wave}, {"figure"}));
}

TEST_CASE("no crease shows where front and back are parted: their vertices have one normal") {
  RiggedCharacter character = figure();
  TriangleMesh& mesh = character.mesh;
  mesh.texture = Image(2, 2);
  mesh.uv = Eigen::MatrixX2f::Constant(mesh.vertices.rows(), 2, 0.75f);
  mesh.back_uv = 0.5f * mesh.uv;
  mesh.first_back = mesh.triangles.rows() / 2 + 3;  // through a limb
  const Glb glb = parseGlb(encodeGlb(character, {}, {"figure"}));
  const json& attributes = glb.document["meshes"][0]["primitives"][0]["attributes"];
  const std::vector<double> positions = numbers(glb, attributes["POSITION"]),
                            normals = numbers(glb, attributes["NORMAL"]);
  REQUIRE(positions.size() > 3 * std::size_t(mesh.vertices.rows()));
  const std::vector<int> source = splitSeams(mesh).source;
  REQUIRE(normals.size() == 3 * source.size());
  for (std::size_t i = 0; i < normals.size(); ++i)
    REQUIRE(normals[i] == normals[3 * std::size_t(source[i / 3]) + i % 3]);
}

TEST_CASE("a GLB says where joints go and how large they are, and lasts as long as the clip") {
  const RiggedCharacter character = figure();
  const int head = character.skeleton.index("head");
  Clip clip;
  clip.name = "grow";
  clip.least_duration_s = 3;
  clip.root_times_s = {0, 2};
  clip.root_translations = {{0, 0, 0}, {0, 1, 0}};
  JointTrack track;
  track.joint = "pelvis";
  track.translation_times_s = {0, 1, 2};
  track.translations_m = {{0, 0, 0}, {0, 0, 1}, {0, 0, 0}};
  clip.tracks.push_back(track);
  track.joint = "head";
  track.translation_times_s = {0, 1};
  track.translations_m = {{0, 0, 0}, {0.5f, 0, 0}};
  track.scale_times_s = {0};
  track.scales = {{2, 2, 2}};
  clip.tracks.push_back(track);
  const Glb glb = parseGlb(encodeGlb(character, {clip}, {"figure"}));
  const json& animation = glb.document["animations"][0];
  std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> channels;
  for (const json& channel : animation["channels"]) {
    const json& sampler = animation["samplers"][channel["sampler"].get<int>()];
    const json& target = channel["target"];
    const std::string joint = glb.document["nodes"][target["node"].get<int>()]["name"];
    channels[joint + "." + target["path"].get<std::string>()] = {numbers(glb, sampler["input"]),
                                                                 numbers(glb, sampler["output"])};
  }
  CHECK(channels.size() == 3);
  const auto& [head_times, places] = channels.at("head.translation");
  CHECK(head_times == std::vector<double>{0, 1, 3});
  const Eigen::Vector3d rest =
      character.skeleton.joints[head].position - character.skeleton.joints[head - 1].position;
  CHECK(places[3] == Approx(rest.x() + 0.5));
  CHECK(places[7] == Approx(rest.y()));
  CHECK(channels.at("head.scale").second == std::vector<double>{2, 2, 2});
  // Heights and metres together.
  const auto& [root_times, root] = channels.at("pelvis.translation");
  const double height = character.mesh.vertices.col(1).maxCoeff() - character.mesh.vertices.col(1).minCoeff();
  const Eigen::Vector3d pelvis = character.skeleton.joints[0].position;
  CHECK(root_times == std::vector<double>{0, 1, 2});
  CHECK(root[4] == Approx(pelvis.y() + 0.5 * height));
  CHECK(root[5] == Approx(pelvis.z() + 1));
  CHECK(root[7] == Approx(pelvis.y() + height));
}

TEST_CASE("meshes without texture, with repeating texture, with many vertices are written too") {
  RiggedCharacter character = figure();
  SECTION("no texture") {
    character.mesh.texture = Image();
    character.mesh.uv.resize(0, 2);
    const Glb glb = parseGlb(encodeGlb(character, {}));
    checkStructure(glb, character);
    CHECK_FALSE(glb.document.contains("images"));
    CHECK_FALSE(glb.document.contains("animations"));
  }
  SECTION("texture coordinates beyond the picture") {
    character.mesh.uv *= 3;
    const Glb glb = parseGlb(encodeGlb(character, {}));
    checkStructure(glb, character);
    CHECK(glb.document["samplers"][0]["wrapS"] == 10497);
    const int accessor = glb.document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"];
    CHECK(numbers(glb, accessor)[1] == Approx(character.mesh.uv(0, 1)));
  }
  SECTION("more vertices than 16 bits can count") {
    const Eigen::Index old = character.mesh.vertices.rows(), count = 70000;
    character.mesh.vertices.conservativeResize(count, 3);
    character.mesh.uv.conservativeResize(count, 2);
    character.weights.joints.conservativeResize(count, 4);
    character.weights.weights.conservativeResize(count, 4);
    for (Eigen::Index i = old; i < count; ++i) {
      character.mesh.vertices.row(i) = character.mesh.vertices.row(i % old);
      character.mesh.uv.row(i) = character.mesh.uv.row(i % old);
      character.weights.joints.row(i) = character.weights.joints.row(i % old);
      character.weights.weights.row(i) = character.weights.weights.row(i % old);
    }
    character.mesh.triangles(0, 0) = int(count) - 1;
    checkStructure(parseGlb(encodeGlb(character, {})), character);
  }
}

TEST_CASE("a clip that moves the root moves it from its rest position, in the model's scale") {
  const RiggedCharacter character = figure();
  Clip hop;
  hop.name = "hop";
  hop.root_times_s = {0, 0.5f};
  hop.root_translations = {{0, 0, 0}, {0, 0.1f, 0}};
  const Glb glb = parseGlb(encodeGlb(character, {hop}));
  const json& animation = glb.document["animations"][0];
  CHECK(animation["channels"][0]["target"]["path"] == "translation");
  const std::vector<double> values = numbers(glb, animation["samplers"][0]["output"]);
  const double height = character.mesh.vertices.col(1).maxCoeff() - character.mesh.vertices.col(1).minCoeff();
  CHECK(values[1] == Approx(character.skeleton.joints[0].position.y()));
  CHECK(values[4] == Approx(character.skeleton.joints[0].position.y() + 0.1 * height));
}

TEST_CASE("joints are named as the target program wants them") {
  const RiggedCharacter character = figure();
  for (const JointNaming naming : {JointNaming::kSkel, JointNaming::kVrm, JointNaming::kMixamo}) {
    ExportOptions options;
    options.naming = naming;
    options.name = "head";  // also a joint's name
    checkStructure(parseGlb(encodeGlb(character, {}, options)), character);
  }
  CHECK(exportedJointName("left_elbow", JointNaming::kVrm) == "leftLowerArm");
  CHECK(exportedJointName("left_elbow", JointNaming::kMixamo) == "mixamorig:LeftForeArm");
  CHECK(exportedJointName("tail", JointNaming::kMixamo) == "tail");
  std::set<std::string> vrm;
  for (const Joint& joint : character.skeleton.joints)
    vrm.insert(exportedJointName(joint.name, JointNaming::kVrm));
  for (const char* bone : {"hips", "spine", "head", "leftUpperArm", "leftLowerArm", "leftHand",
                           "rightUpperArm", "rightLowerArm", "rightHand", "leftUpperLeg", "leftLowerLeg",
                           "leftFoot", "rightUpperLeg", "rightLowerLeg", "rightFoot"})
    CHECK(vrm.count(bone) == 1);
}

TEST_CASE("what is no biped keeps all its names, not some") {
  const SkeletonTemplate plan = loadTemplate("quadruped");
  Skeleton animal;
  for (const TemplateJoint& joint : plan.joints) animal.joints.push_back({joint.name, joint.parent, {}});
  for (const JointNaming naming : {JointNaming::kVrm, JointNaming::kMixamo}) {
    CHECK_FALSE(namesFit(animal, naming));
    CHECK(namesFit(figure().skeleton, naming));
    const std::vector<std::string> names = exportedJointNames(animal, naming);
    for (std::size_t j = 0; j < names.size(); ++j) CHECK(names[j] == animal.joints[j].name);
  }
}

TEST_CASE("a character moves in the same way whatever the axes of its joints are") {
  const RiggedCharacter character = figure();
  std::vector<Clip> clips;
  for (const Clip& clip : clipsFor(builtinClips(), character.skeleton))
    clips.push_back(retargetToRest(clip, character.skeleton));
  Clip stretch;
  stretch.name = "stretch";
  JointTrack track;
  track.joint = "left_hand";
  track.translation_times_s = {0, 1};
  track.translations_m = {{0, 0, 0}, {0.1f, 0.2f, 0.3f}};
  track.scale_times_s = {0, 1};
  track.scales = {{1, 1, 1}, {1, 2, 1}};
  stretch.tracks = {track};
  clips.push_back(stretch);
  REQUIRE(clips.size() > 8);
  const Glb along = parseGlb(encodeGlb(character, clips));
  const double height = character.mesh.vertices.col(1).maxCoeff() - character.mesh.vertices.col(1).minCoeff();
  for (const BoneStyle style : {BoneStyle::kEnds, BoneStyle::kPlain}) {
    const Glb other = parseGlb(encodeGlb(character, clips, {.bones = style}));
    for (std::size_t c = 0; c < clips.size(); ++c) {
      const auto vertices = [&](const Glb& glb, double time_s) {
        return posed(glb, glb.document["animations"][c], time_s);
      };
      for (const double share : {0., .23, .5, .81}) {
        const double time_s = share * clips[c].duration_s();
        CHECK((vertices(other, time_s) - vertices(along, time_s)).cwiseAbs().maxCoeff() < 1e-4 * height);
      }
      CHECK((vertices(along, .5 * clips[c].duration_s()) - vertices(along, 0)).norm() > 1e-2);
    }
  }
}

TEST_CASE("plain bones have the model's axes") {
  const RiggedCharacter character = figure();
  const Glb glb = parseGlb(encodeGlb(character, {}, {.bones = BoneStyle::kPlain}));
  checkStructure(glb, character);
  for (const json& node : glb.document["nodes"]) CHECK_FALSE(node.contains("rotation"));
}

TEST_CASE("the last bones end in joints at the far end of what they move, which move nothing") {
  const RiggedCharacter character = figure();
  const Glb glb =
      parseGlb(encodeGlb(character, {}, {.naming = JointNaming::kMixamo, .bones = BoneStyle::kEnds}));
  const json &nodes = glb.document["nodes"], &skin = glb.document["skins"][0];
  const std::vector<int> parents = parentsOf(nodes);
  std::map<std::string, int> ends;
  const std::size_t own = character.skeleton.joints.size();
  for (std::size_t j = own; j < skin["joints"].size(); ++j) {
    const int node = skin["joints"][j];
    CHECK(nodes[node]["extras"]["end"] == true);
    CHECK(nodes[node]["name"] == nodes[parents[node]]["name"].get<std::string>() + "_end");
    ends[nodes[node]["name"]] = node;
    // +y of the bone runs to its end.
    const Eigen::Affine3d bone = restTransform(nodes, parents, parents[node]);
    const Eigen::Vector3d there = bone.inverse() * restTransform(nodes, parents, node).translation();
    CHECK(there.normalized().y() > .9999);
  }
  // head_top moves nothing in this figure.
  CHECK(ends.size() == 4);
  for (const double joint :
       numbers(glb, glb.document["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"]))
    CHECK(joint < double(own));
  const Eigen::Vector3d hand = restTransform(nodes, parents, ends.at("mixamorig:LeftHand_end")).translation();
  const Joint& wrist = character.skeleton.joints[character.skeleton.index("left_hand")];
  CHECK((hand - wrist.position).norm() == Approx(.35 * .2).margin(1e-4));
  const double ground = character.mesh.vertices.col(1).minCoeff();
  CHECK(restTransform(nodes, parents, ends.at("mixamorig:RightFoot_end")).translation().y() > ground);
}

TEST_CASE("a bone ends in the middle of its far end, straight ahead where that is as wide as long") {
  RiggedCharacter character;
  character.skeleton.joints.resize(2);
  character.skeleton.joints[0].name = "pelvis";
  character.skeleton.joints[1].name = "tip";
  character.skeleton.joints[1].parent = 0;
  character.skeleton.joints[1].position = {0, 1, 0};
  character.weights.joints.setZero(3, 4);
  character.weights.joints.block(1, 0, 2, 1).setOnes();
  character.weights.weights.setZero(3, 4);
  character.weights.weights.col(0).setOnes();
  character.mesh.vertices.resize(3, 3);
  const auto end = [&](float x, float y) -> Eigen::Vector3d {
    character.mesh.vertices << 0, 0, 0, x, y, 0, 2 * x, y, 0;
    const Skeleton ends = withBoneEnds(character.skeleton, character.mesh, character.weights);
    return ends.joints[ends.index("tip_end")].position;
  };
  CHECK((end(0.1f, 1.5f) - Eigen::Vector3d(0.15, 1.5, 0)).norm() < 1e-6);
  CHECK((end(1, 1.5f) - Eigen::Vector3d(0, 1.5, 0)).norm() < 1e-6);

  // Aslant and down: never below what it moves.
  character.skeleton.joints[0].position = {-1, 2, 0};
  character.mesh.vertices << 0, -9, 0, 1, .5f, 0, 2, .5f, 0;
  const Skeleton ends = withBoneEnds(character.skeleton, character.mesh, character.weights);
  CHECK(ends.joints[ends.index("tip_end")].position.y() >= .5);
}

TEST_CASE("a foot that moves nothing more than others do had no end, and was drawn as long as its shin") {
  RiggedCharacter character = figure();
  const int foot = int(character.skeleton.index("left_foot")),
            knee = int(character.skeleton.index("left_knee"));
  SkinWeights& weights = character.weights;
  for (Eigen::Index v = 0; v < weights.joints.rows(); ++v) {
    if (weights.joints(v, 0) != foot) continue;
    weights.joints.row(v).setZero();
    weights.weights.row(v).setZero();
    weights.joints(v, 0) = std::uint16_t(knee);
    weights.joints(v, 1) = std::uint16_t(foot);
    weights.weights(v, 0) = .6f;
    weights.weights(v, 1) = .4f;
  }
  const auto lengthOf = [&](const char* side) {
    const Skeleton ends = withBoneEnds(character.skeleton, character.mesh, weights);
    const auto at = [&](const char* joint) {
      return ends.joints[ends.index(side + std::string(joint))].position;
    };
    return (at("foot_end") - at("foot")).norm() / (at("foot") - at("knee")).norm();
  };
  CHECK(lengthOf("left_") == Approx(.4));
  // One that moves nothing at all has none.
  weights.joints = (weights.joints.array() == foot).select(std::uint16_t(knee), weights.joints.array());
  CHECK(withBoneEnds(character.skeleton, character.mesh, weights).find("left_foot_end") < 0);
}

TEST_CASE("a bone with a tail ends there, and a taken name is left alone") {
  RiggedCharacter character = figure();
  Joint& hand = character.skeleton.joints[character.skeleton.index("left_hand")];
  hand.tail = Eigen::Vector3d(1, 1, 1);
  Joint taken;
  taken.name = "right_hand_end";
  taken.parent = 0;
  character.skeleton.joints.push_back(taken);
  const Skeleton with_ends = withBoneEnds(character.skeleton, character.mesh, character.weights);
  CHECK(with_ends.joints[with_ends.index("left_hand_end")].position == Eigen::Vector3d(1, 1, 1));
  CHECK(with_ends.joints[with_ends.index("right_hand_end")].parent == 0);
}

TEST_CASE("geometry stays small") {
  RiggedCharacter character = figure();
  const double per_vertex = double(encodeGlb(character, {}).size()) / double(character.mesh.vertices.rows());
  CHECK(per_vertex < 0.3e6 / 4100 + 20);  // 20: JSON, texture and skin of this small figure
}

TEST_CASE("the name of a drawing need not be UTF-8") {
  ExportOptions options;
  options.name = "caf\xe9";
  const Glb glb = parseGlb(encodeGlb(figure(), {}, options));
  CHECK(glb.document["scenes"][0]["name"] == "caf\xef\xbf\xbd");
}

TEST_CASE("what is no character, or no clip of it, is refused, not an abort") {
  const RiggedCharacter good = figure();
  const auto said = [](const RiggedCharacter& character, const std::vector<Clip>& clips = {}) {
    try {
      encodeGlb(character, clips);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("no UsageError");
  };
  using Catch::Matchers::Contains;
  CHECK_THAT(said({}), Contains("has no mesh: no figure was found"));
  RiggedCharacter joints_alone;
  joints_alone.skeleton = good.skeleton;
  CHECK_THAT(said(joints_alone), Contains("has no mesh"));
  RiggedCharacter character = good;
  character.skeleton.joints.clear();
  CHECK_THAT(said(character), Contains("RiggedCharacter::skeleton has no joints"));
  character = good;
  character.skeleton.joints[3].name = "\xff";
  CHECK_THAT(said(character), Contains("RiggedCharacter::skeleton.joints[3]") && Contains("no UTF-8"));
  character = good;
  character.weights.joints.conservativeResize(5, 4);
  CHECK_THAT(said(character), Contains("RiggedCharacter::weights has 5 rows of joints"));
  character = good;
  character.weights.joints(0, 0) = 99;
  CHECK_THAT(said(character), Contains("RiggedCharacter::weights.joints"));
  character = good;
  character.mesh.vertices(3, 1) = std::numeric_limits<float>::quiet_NaN();
  CHECK_THAT(said(character), Contains("RiggedCharacter::mesh.vertices"));
  character = good;
  character.mesh.uv.setZero(2, 2);
  CHECK_THAT(said(character), Contains("RiggedCharacter::mesh.uv has 2 rows"));

  Clip clip = retargetToRest(clipNamed(builtinClips(), "wave"), good.skeleton);
  clip.tracks[2].joint = "wing";
  CHECK_THAT(said(good, {clip}), Contains("the clip \"wave\" moves \"wing\", which this skeleton lacks"));
  clip = retargetToRest(clipNamed(builtinClips(), "wave"), good.skeleton);
  clip.tracks[0].times_s.push_back(9);
  CHECK_THAT(said(good, {clip}), Contains("the clip \"wave\": tracks[0].rotations has"));
}
