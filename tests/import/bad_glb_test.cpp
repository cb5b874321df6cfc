// GLB files that must be refused, each with its place in the document.
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>

#include "libskel/animation/clip.h"
#include "libskel/core/error.h"
#include "libskel/import/read_character.h"
#include "tests/support/catch.h"
#include "tests/support/figure.h"

using namespace skel;
using nlohmann::json;

namespace {

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

void setWord(std::string& bytes, std::size_t at, std::uint32_t value) {
  std::memcpy(bytes.data() + at, &value, 4);
}

const std::string& goodGlb() {
  static const std::string bytes = [] {
    const RiggedCharacter character = figure();
    Clip clip;
    clip.name = "nod";
    JointTrack track;
    track.joint = "head";
    track.times_s = {0, 1};
    track.rotations = {Eigen::Quaternionf::Identity(), Eigen::Quaternionf(0.8f, 0.6f, 0, 0)};
    clip.tracks = {track};
    return encodeGlb(character, {clip}, {.name = "figure"});
  }();
  return bytes;
}

// The good file with its document changed, and its numbers.
std::string changed(const std::function<void(json&, std::string&)>& change) {
  std::string bytes = goodGlb();
  const std::size_t size = word(bytes, 12);
  json document = json::parse(bytes.substr(20, size));
  std::string binary = bytes.substr(28 + size);
  change(document, binary);
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string result = bytes.substr(0, 20) + text + std::string(8, 0) + binary;
  setWord(result, 8, static_cast<std::uint32_t>(result.size()));
  setWord(result, 12, static_cast<std::uint32_t>(text.size()));
  setWord(result, 20 + text.size(), static_cast<std::uint32_t>(binary.size()));
  std::memcpy(result.data() + 24 + text.size(), "BIN", 4);
  return result;
}

std::string complaint(const std::string& bytes) {
  try {
    decodeGlb(bytes, "a.glb");
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("GLB files that are cut off, or of another kind, are refused") {
  const std::string& good = goodGlb();
  CHECK(complaint(changed([](json&, std::string&) {})) == "none");
  CHECK(complaint("") == "a.glb: is empty, not a GLB file");
  CHECK(complaint("solid") == "a.glb: is not a GLB file");
  CHECK(complaint(good.substr(0, 100)).find("a.glb: is cut off: 100 of ") == 0);
  std::string bytes = good;
  bytes[4] = 1;
  CHECK(complaint(bytes) == "a.glb: is of glTF version 1, 2 is read");
  bytes = good;
  setWord(bytes, 12, 0x7fffffff);
  CHECK(complaint(bytes).find("a.glb: is cut off: a chunk of 2147483647 bytes has only ") == 0);
  bytes = good;
  bytes[16] = 'X';
  CHECK(complaint(bytes) == "a.glb: its first chunk is not JSON");
  for (std::size_t cut = 0; cut < 400; ++cut) CHECK(complaint(good.substr(0, cut)) != "none");
}

TEST_CASE("a GLB that lists very many buffers is read as fast as its length says") {
  // Each look at one copied the list: 10^11 steps.
  const std::string bytes = changed([](json& d, std::string&) {
    for (int i = 0; i < 2'000'000; ++i) d["buffers"].push_back(json::object());
    const json clip = d["animations"][0];
    for (int i = 0; i < 20'000; ++i) d["animations"].push_back(clip);
  });
  CHECK(decodeGlb(bytes, "a.glb").clips.size() > 0);
}

TEST_CASE("more clips than can be held against each other are refused") {
  const std::string bytes = changed([](json& d, std::string&) {
    const json clip = {{"name", "a"}, {"channels", json::array()}, {"samplers", {json::object()}}};
    d["animations"] = json(25'001, clip);
  });
  CHECK(complaint(bytes) == "a.glb: animations: are 25001, at most 25000 are read; export fewer");
}

TEST_CASE("GLB files that mean something else are refused with their place") {
  struct Case {
    std::function<void(json&, std::string&)> change;
    std::string message;
  };
  const std::vector<Case> cases = {
      {[](json& d, std::string&) { d["asset"]["version"] = "1.0"; },
       "asset.version: is \"1.0\", 2.0 is read"},
      {[](json& d, std::string&) { d["extensionsRequired"] = {"KHR_draco"}; },
       "extensionsRequired: names \"KHR_draco\", which is not read"},
      {[](json& d, std::string&) { d["nodes"][0].erase("mesh"); }, "nodes: hold no mesh"},
      {[](json& d, std::string&) { d["nodes"][0].erase("skin"); }, "nodes[0].mesh: has no skin"},
      {[](json& d, std::string&) { d["nodes"][3]["mesh"] = 0; }, "nodes[3].mesh: is a second mesh"},
      {[](json& d, std::string&) { d["nodes"][0]["mesh"] = 7; },
       "nodes[0].mesh: is 7, must be a whole number between 0 and 0"},
      {[](json& d, std::string&) { d["nodes"][2]["name"] = "pelvis"; },
       "nodes[2].name: \"pelvis\" is the name of two joints"},
      {[](json& d, std::string&) { d["nodes"][5]["children"] = {1}; }, "nodes: are in a circle"},
      {[](json& d, std::string&) { d["nodes"][0]["children"] = {2}; }, "node 2 has two parents"},
      {[](json& d, std::string&) {
         d["nodes"][2]["rotation"] = {0, 0, 0.6, 0.8};
       },
       "skins[0].inverseBindMatrices: that of \"body\" is not where its node stands"},
      {[](json& d, std::string&) {
         d["nodes"][2]["scale"] = {1, 2, 1};
       },
       "nodes[2]: the joint \"body\" is scaled in the rest pose"},
      {[](json& d, std::string&) {
         json& channel = d["animations"][0]["channels"][0];
         const int output = d["animations"][0]["samplers"][channel["sampler"].get<int>()]["output"];
         channel["target"] = {{"node", d["skins"][0]["joints"][5]}, {"path", "scale"}};
         d["accessors"][output]["type"] = "VEC3";
       },
       " scales a turned joint unevenly, which is not read"},
      {[](json& d, std::string&) {
         d["nodes"][2]["translation"] = {0, 0};
       },
       "nodes[2].translation: has 2 numbers, must have 3"},
      {[](json& d, std::string&) {
         d["nodes"][2]["translation"] = {0, 5, 0};
       },
       "skins[0].inverseBindMatrices: that of \"body\" is not where its node stands"},
      {[](json& d, std::string&) { d["skins"][0]["joints"][3] = 1; },
       "skins[0].joints[3]: node 1 stands here for the second time"},
      {[](json& d, std::string&) { d["skins"][0]["joints"].erase(3); }, "hangs on a node that is no joint"},
      {[](json& d, std::string& bytes) {
         const json& positions =
             d["accessors"][d["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<int>()];
         const json& view = d["bufferViews"][positions["bufferView"].get<int>()];
         bytes.replace(view.value("byteOffset", 0), view["byteLength"].get<std::size_t>(),
                       view["byteLength"].get<std::size_t>(), '\0');
       },
       ".POSITION: has all vertices at one place"},
      {[](json& d, std::string&) { d["meshes"][0]["primitives"].push_back(d["meshes"][0]["primitives"][0]); },
       "meshes[0].primitives: has 2 elements, one is read"},
      {[](json& d, std::string&) { d["meshes"][0]["primitives"][0]["mode"] = 1; },
       "meshes[0].primitives[0].mode: must be triangles"},
      {[](json& d, std::string&) { d["meshes"][0]["primitives"][0]["attributes"]["JOINTS_1"] = 0; },
       "attributes.JOINTS_1: is not read"},
      {[](json& d, std::string&) { d["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0"); },
       "meshes[0].primitives[0].attributes: lacks \"WEIGHTS_0\""},
      {[](json& d, std::string&) {
         d["accessors"][d["meshes"][0]["primitives"][0]["indices"].get<int>()]["count"] = 4000000000u;
       },
       "elements, more than its buffer view holds"},
      {[](json& d, std::string&) {
         d["accessors"][d["meshes"][0]["primitives"][0]["indices"].get<int>()]["count"] = 4;
       },
       "meshes[0].primitives[0].indices: has 4 corners, no multiple of 3"},
      {[](json& d, std::string&) {
         d["accessors"][d["meshes"][0]["primitives"][0]["indices"].get<int>()]["type"] = "VEC3";
       },
       ".type: is VEC3, must be SCALAR"},
      {[](json& d, std::string&) { d["bufferViews"][0]["byteLength"] = 1e9; },
       "bufferViews[0]: ends at byte "},
      {[](json& d, std::string&) { d["buffers"][0]["uri"] = "a.bin"; },
       "buffers[0]: lies outside of the file"},
      {[](json& d, std::string& binary) {
         const int view = d["accessors"][d["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<int>()]
                           ["bufferView"];
         setWord(binary, d["bufferViews"][view].value("byteOffset", 0u) + 8, 0x7fc00000);
       },
       "attributes.POSITION: number 2 of element 0 is not finite"},
      {[](json& d, std::string& binary) {
         const int view = d["accessors"][d["meshes"][0]["primitives"][0]["indices"].get<int>()]["bufferView"];
         setWord(binary, d["bufferViews"][view].value("byteOffset", 0u), 0xfffffffe);
       },
       "meshes[0].primitives[0].indices: triangle 0 has vertex 65534 of "},
      {[](json& d, std::string& binary) {
         const int view =
             d["accessors"][d["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"].get<int>()]
              ["bufferView"];
         const std::size_t at = d["bufferViews"][view].value("byteOffset", 0u);
         setWord(binary, at, 0), setWord(binary, at + 4, 0);
       },
       "attributes.WEIGHTS_0: vertex 0 has no weights"},
      {[](json& d, std::string& binary) {
         const int view = d["accessors"][d["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"].get<int>()]
                           ["bufferView"];
         setWord(binary, d["bufferViews"][view].value("byteOffset", 0u), 0xffffffff);
       },
       "attributes.JOINTS_0: vertex 0 has joint 255 of 17"},
      {[](json& d, std::string&) { d["nodes"].back()["extras"]["end"] = true; },
       "attributes.JOINTS_0: vertex 2052 is moved by the end of a bone"},
      {[](json& d, std::string&) {
         for (const int joint : d["skins"][0]["joints"]) d["nodes"][joint]["extras"]["end"] = true;
       },
       "skins[0].joints: holds nothing but ends of bones"},
      {[](json& d, std::string&) { d["animations"][0]["channels"][0]["target"]["node"] = 0; },
       "animations[0].channels[0].target.node: is no joint of the skin"},
      {[](json& d, std::string&) { d["animations"][0]["channels"][0]["target"]["path"] = "weights"; },
       "animations[0].channels[0].target.path: \"weights\" is not read"},
      {[](json& d, std::string&) { d["animations"][0]["samplers"][0]["interpolation"] = "CUBICSPLINE"; },
       "animations[0].samplers[0].interpolation: CUBICSPLINE is not read"},
      {[](json& d, std::string&) {
         d["animations"][0]["channels"].push_back(d["animations"][0]["channels"][0]);
       },
       "animations[0].channels[1].target: is moved by two channels"},
      {[](json& d, std::string& binary) {
         const int view = d["accessors"][d["animations"][0]["samplers"][0]["input"].get<int>()]["bufferView"];
         setWord(binary, d["bufferViews"][view].value("byteOffset", 0u) + 4, 0);
       },
       "animations[0].samplers[0].input: time 1 is not later than the one before"},
      {[](json& d, std::string& binary) {
         const json& positions =
             d["accessors"][d["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<int>()];
         const std::size_t at = d["bufferViews"][positions["bufferView"].get<int>()].value("byteOffset", 0u);
         for (std::size_t v = 0; v < positions["count"]; ++v) setWord(binary, at + 12 * v + 4, 0);
       },
       "POSITION: is flat: it has no height along y"},
      {[](json& d, std::string&) { d["images"][0]["uri"] = "a.png"; },
       "images[0].uri: lies outside of the file"},
      {[](json& d, std::string& binary) {
         const int view = d["images"][0]["bufferView"];
         binary[d["bufferViews"][view].value("byteOffset", 0u)] = 'X';
       },
       "a.glb: images[0]: is not a picture that can be read"},
      {[](json& d, std::string&) {
         d["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 0, 0, 1};
       },
       "materials[0].pbrMetallicRoughness.baseColorFactor: is not read beside a picture"},
  };
  for (const Case& c : cases) {
    const std::string said = complaint(changed(c.change));
    INFO(said << " should hold " << c.message);
    CHECK(said.find("a.glb: ") == 0);
    CHECK(said.find(c.message) != std::string::npos);
    CHECK(said.find('\n') == std::string::npos);
  }
}

TEST_CASE("the end of a bone moves nothing: what other programs say of its motion is left out") {
  const std::string bytes = changed([](json& document, std::string&) {
    for (std::size_t i = 0; i < document["nodes"].size(); ++i) {
      if (document["nodes"][i]["name"] != "head_top") continue;
      document["nodes"][i]["extras"]["end"] = true;
      document["animations"][0]["channels"][0]["target"]["node"] = i;
    }
  });
  const CharacterFile file = decodeGlb(bytes, "a.glb");
  CHECK(file.character.skeleton.find("head_top") < 0);
  CHECK(file.clips.at(0).tracks.empty());
}

TEST_CASE("a texture that shines in part may be two textures of one image, as Blender writes it") {
  const auto with = [](int image) {
    return complaint(changed([&](json& document, std::string&) {
      document["images"].push_back(document["images"][0]);
      document["textures"].push_back({{"sampler", 0}, {"source", image}});
      document["materials"][0]["emissiveTexture"]["index"] = 1;
    }));
  };
  CHECK(with(0) == "none");
  CHECK(with(1).find("baseColorFactor: is not read") != std::string::npos);
}

TEST_CASE("a model whose only material has a plain colour was refused") {
  const auto meshWith = [](const json& factor, const json& shine) {
    return decodeGlb(changed([&](json& document, std::string&) {
                       json& material = document["materials"][0];
                       material.erase("emissiveTexture");
                       material["emissiveFactor"] = shine;
                       material["pbrMetallicRoughness"].erase("baseColorTexture");
                       material["pbrMetallicRoughness"]["baseColorFactor"] = factor;
                     }),
                     "a.glb")
        .character.mesh;
  };
  const auto shows = [](const TriangleMesh& mesh, int r, int g, int b) {
    REQUIRE(mesh.uv.rows() == mesh.vertices.rows());
    for (Eigen::Index i = 0; i < mesh.texture.rgba.rows(); ++i) {
      const Eigen::Array4i rgba = mesh.texture.rgba.row(i).cast<int>();
      if ((rgba != Eigen::Array4i(r, g, b, 255)).any()) return false;
    }
    return !mesh.texture.empty();
  };
  const json dark = {0, 0, 0};
  // Factors are of linear light.
  CHECK(shows(meshWith({1, 0.2158605, 0, 1}, dark), 255, 128, 0));
  CHECK(shows(meshWith({0, 0, 0, 1}, {1, 0.2158605, 0}), 255, 128, 0));
  CHECK(meshWith({1, 1, 1, 1}, dark).texture.empty());
}

TEST_CASE("an animation of 1e8 s, which became a film of one frame, is refused") {
  const std::string bytes = changed([](json& document, std::string& binary) {
    const json& accessor =
        document["accessors"][document["animations"][0]["samplers"][0]["input"].get<std::size_t>()];
    const json& view = document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const float late = 1e8f;
    std::memcpy(binary.data() + view.value("byteOffset", 0) + accessor.value("byteOffset", 0) + 4, &late, 4);
  });
  CHECK(complaint(bytes).find("ends after more than an hour; cut the animation into parts") !=
        std::string::npos);
}

TEST_CASE("keys that clips share are counted each time: a few bytes do not become gigabytes") {
  constexpr std::size_t kKeys = 40'000;
  const auto copies = [&](std::size_t count) {
    return changed([&](json& document, std::string& binary) {
      const auto append = [&](std::size_t accessor, int width, const std::function<float(std::size_t)>& at) {
        document["accessors"][accessor]["count"] = kKeys;
        document["accessors"][accessor].erase("min");
        document["accessors"][accessor].erase("max");
        document["accessors"][accessor]["byteOffset"] = 0;
        document["accessors"][accessor]["bufferView"] = document["bufferViews"].size();
        const std::size_t bytes = kKeys * static_cast<std::size_t>(width) * 4;
        document["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes}});
        for (std::size_t i = 0; i < bytes / 4; ++i) {
          const float number = at(i);
          binary.append(reinterpret_cast<const char*>(&number), 4);
        }
      };
      const json animation = document["animations"][0], sampler = animation["samplers"][0];
      append(sampler["input"], 1, [](std::size_t i) { return static_cast<float>(i) / 64; });
      append(sampler["output"], 4, [](std::size_t i) { return i % 4 == 3 ? 1.f : 0.f; });
      document["buffers"][0]["byteLength"] = binary.size();
      document["animations"] = json::array();
      for (std::size_t i = 0; i < count; ++i) document["animations"].push_back(animation);
    });
  };
  CHECK(complaint(copies(10)) == "none");
  CHECK(complaint(copies(251)) ==
        "a.glb: animations[250].samplers[0].input: brings all clips to more than 10 million keys; export "
        "fewer animations, or fewer keys");
}

TEST_CASE("a joint or a vertex beyond a million units, which ended the binding of weights, is refused") {
  CHECK_THAT(complaint(changed([](json& document, std::string&) {
               for (json& node : document["nodes"])
                 if (node["name"] == "head") node["translation"] = {-1e308, 0, 0};
             })),
             Catch::Matchers::Contains("the joint \"head\" is farther than 1e6 from the origin"));
  CHECK_THAT(complaint(changed([](json& document, std::string& binary) {
               const json& primitive = document["meshes"][0]["primitives"][0];
               const json& accessor = document["accessors"][std::size_t(primitive["attributes"]["POSITION"])];
               const json& view = document["bufferViews"][std::size_t(accessor["bufferView"])];
               const float far = 1e30f;
               std::memcpy(binary.data() + view.value("byteOffset", std::size_t(0)), &far, 4);
             })),
             Catch::Matchers::Contains("has a vertex farther than 1e6 from the origin"));
}
