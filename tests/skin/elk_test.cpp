// What an animal asks of skin weights: parts that follow, legs that leave each other alone, mathematics.
#include "tests/support/elk.h"

#include <numbers>
#include <set>

#include "libskel/core/error.h"
#include "libskel/skin/parts.h"
#include "libskel/skin/solid.h"
#include "tests/support/catch.h"
#include "tests/support/skin_checks.h"

using namespace skel;

namespace {

MeshParts partsOf(const TriangleMesh& mesh) { return meshParts(mesh, Welding(mesh.vertices)); }

// 0 front left, 1 front right, 2 hind left, 3 hind right; -1: no leg.
int legOf(const std::string& joint) {
  const int side = joint.ends_with("_l") ? 0 : 1;
  for (const char* part : {"shoulder", "upper_arm", "forearm", "front_"})
    if (joint.starts_with(part)) return side;
  for (const char* part : {"hip", "thigh", "shin", "hind_"})
    if (joint.starts_with(part)) return 2 + side;
  return -1;
}

void checkRows(const SkinWeights& weights, int joint_count, int max_influences) {
  for (Eigen::Index v = 0; v < weights.weights.rows(); ++v) {
    const auto row = weights.weights.row(v);
    REQUIRE(std::abs(row.sum() - 1) < 1e-6f);
    REQUIRE(row[0] > 0);
    std::set<int> joints;
    for (int k = 0; k < 4; ++k) {
      REQUIRE(row[k] >= 0);
      if (k > 0) REQUIRE(row[k] <= row[k - 1]);
      if (k >= max_influences || row[k] == 0) {
        REQUIRE(row[k] == 0);
        REQUIRE(weights.joints(v, k) == 0);
      } else {
        REQUIRE(weights.joints(v, k) < joint_count);
        REQUIRE(joints.insert(weights.joints(v, k)).second);
      }
    }
  }
}

// Meshes as they come, made of the elk.
struct Named {
  std::string name;
  TriangleMesh mesh;
};

std::vector<Named> meshesAsTheyCome() {
  const TriangleMesh& elk = elkMesh();
  std::vector<Named> meshes = {{"as it is", elk}};
  // Every triangle its own three vertices.
  TriangleMesh soup;
  soup.vertices.resize(3 * elk.triangles.rows(), 3);
  soup.triangles.resize(elk.triangles.rows(), 3);
  for (Eigen::Index t = 0; t < elk.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) {
      soup.vertices.row(3 * t + k) = elk.vertices.row(elk.triangles(t, k));
      soup.triangles(t, k) = static_cast<int>(3 * t + k);
    }
  meshes.push_back({"no two triangles share a vertex", soup});
  TriangleMesh flipped = elk;
  for (Eigen::Index t = 0; t < flipped.triangles.rows(); t += 3)
    std::swap(flipped.triangles(t, 0), flipped.triangles(t, 1));
  meshes.push_back({"every third face looks inwards", flipped});
  TriangleMesh open = elk;
  std::vector<int> kept;
  for (int t = 0; t < elk.triangles.rows(); ++t)
    if (elk.vertices(elk.triangles(t, 0), 0) > -0.02f) kept.push_back(t);
  open.triangles = elk.triangles(kept, Eigen::all);
  meshes.push_back({"the left half alone", open});
  TriangleMesh sheets = elk;  // the right half as a sheet of its own, not joined
  std::vector<int> copy(static_cast<std::size_t>(elk.vertices.rows()), -1);
  for (Eigen::Index t = 0; t < sheets.triangles.rows(); ++t) {
    if (elk.vertices(elk.triangles(t, 0), 0) > 0) continue;
    for (int k = 0; k < 3; ++k) {
      int& v = copy[static_cast<std::size_t>(elk.triangles(t, k))];
      if (v < 0) {
        v = static_cast<int>(sheets.vertices.rows());
        sheets.vertices.conservativeResize(v + 1, 3);
        sheets.vertices.row(v) = elk.vertices.row(elk.triangles(t, k)) - Eigen::RowVector3f(0.004f, 0, 0);
      }
      sheets.triangles(t, k) = v;
    }
  }
  meshes.push_back({"two sheets with a gap", sheets});
  TriangleMesh holes = elk;
  kept.clear();
  for (int t = 0; t < elk.triangles.rows(); ++t)
    if (t % 17 != 0) kept.push_back(t);
  holes.triangles = elk.triangles(kept, Eigen::all);
  meshes.push_back({"holes everywhere", holes});
  return meshes;
}

}  // namespace

TEST_CASE("every method gives every vertex of meshes as they come sorted weights that sum to 1") {
  for (const Named& named : meshesAsTheyCome()) {
    for (const SkinMethod method : skinMethods()) {
      INFO(named.name << ", " << skinMethodName(method));
      SkinOptions options;
      options.max_influences = method == SkinMethod::kHeat ? 2 : 4;
      options.smoothing = method == SkinMethod::kIdw ? 2 : 0;
      const SkinWeights weights = computeSkinWeights(named.mesh, elkSkeleton(), method, options);
      checkRows(weights, 38, options.max_influences);
      // A mistaken body would move with one bone.
      std::set<int> used;
      for (Eigen::Index v = 0; v < weights.joints.rows(); ++v) used.insert(weights.joints(v, 0));
      CHECK(used.size() > 20);
    }
  }
}

TEST_CASE("the antlers and the eyes move with the head exactly") {
  const TriangleMesh& mesh = elkMesh();
  const MeshParts parts = partsOf(mesh);
  REQUIRE(parts.count == 5);
  for (const SkinMethod method : {SkinMethod::kGeodesic, SkinMethod::kHeat}) {
    for (const Named& named : meshesAsTheyCome()) {
      if (named.name != "as it is" && named.name != "every third face looks inwards") continue;
      INFO(named.name << ", " << skinMethodName(method));
      const SkinWeights weights = computeSkinWeights(named.mesh, elkSkeleton(), method);
      const int head = elkSkeleton().index("head");
      int followers = 0;
      for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        if (parts.of_vertex[static_cast<std::size_t>(v)] == 0) continue;
        ++followers;
        REQUIRE(weights.joints(v, 0) == head);
        REQUIRE(weights.weights(v, 0) == 1);
      }
      CHECK(followers > 800);
    }
  }
}

TEST_CASE("no vertex of a foot carries weight of another leg") {
  const TriangleMesh& mesh = elkMesh();
  for (const SkinMethod method : {SkinMethod::kGeodesic, SkinMethod::kHeat, SkinMethod::kIdwRegion}) {
    INFO(skinMethodName(method));
    const SkinWeights weights = computeSkinWeights(mesh, elkSkeleton(), method);
    int feet = 0, foreign = 0;
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
      if (mesh.vertices(v, 1) > 0.3f) continue;
      ++feet;
      const int leg = (mesh.vertices(v, 0) > 0 ? 0 : 1) + (mesh.vertices(v, 2) > 0 ? 0 : 2);
      for (int k = 0; k < 4; ++k)
        if (weights.weights(v, k) > 0)
          foreign += legOf(elkSkeleton().joints[weights.joints(v, k)].name) != leg;
    }
    CHECK(feet > 300);
    CHECK(foreign == 0);
  }
}

TEST_CASE("ankles go with one bone, heads with neither legs nor trunk, by the table of regions") {
  const Skeleton& skeleton = elkSkeleton();
  const SkinRegions& table = defaultRegions();
  const std::vector<int> regions = table.ofJoints(skeleton);
  const auto regionOf = [&](const char* joint) { return table.regions[regions[skeleton.index(joint)]].name; };
  CHECK(regionOf("front_hoof_l") == "ankle");
  CHECK(regionOf("hind_cannon_r") == "ankle");
  CHECK(regionOf("shoulder_r") == "shoulder");
  CHECK(regionOf("jaw") == "head");
  CHECK(regionOf("neck_3") == "neck");
  CHECK(regionOf("forearm_l") == "front_leg");
  CHECK(regionOf("thigh_l") == "hind_leg");
  CHECK(regionOf("pelvis") == "trunk");
  CHECK(regionOf("tail_2") == "trunk");
  const SkinWeights weights = computeSkinWeights(elkMesh(), skeleton, SkinMethod::kIdwRegion);
  for (Eigen::Index v = 0; v < weights.joints.rows(); ++v) {
    std::set<std::string> used;
    std::set<int> legs;
    for (int k = 0; k < 4; ++k) {
      if (weights.weights(v, k) == 0) continue;
      used.insert(table.regions[regions[weights.joints(v, k)]].name);
      if (const int leg = legOf(skeleton.joints[weights.joints(v, k)].name); leg >= 0) legs.insert(leg);
    }
    if (used.count("ankle")) REQUIRE(weights.weights(v, 0) == 1);
    if (used.count("head")) {
      for (const char* other : {"trunk", "front_leg", "hind_leg", "shoulder"})
        REQUIRE_FALSE(used.count(other));
    }
  }
}

TEST_CASE("idw is 1 / ((d / d_min)^2 + 0.01) of the four nearest bones") {
  Skeleton skeleton;
  for (int j = 0; j < 5; ++j) {
    Joint joint;
    joint.name = std::to_string(j);
    joint.parent = j - 1;
    joint.position = {j + 1.0, 0, 0};
    joint.tail = Eigen::Vector3d(j + 1.0, 0, 1);
    skeleton.joints.push_back(joint);
  }
  TriangleMesh mesh;
  mesh.vertices.resize(3, 3);
  mesh.vertices << 0, 0, 0.5f, 0, 1, 0.5f, 1, 0, 0.5f;  // the third lies on a bone
  mesh.triangles.resize(1, 3);
  mesh.triangles << 0, 1, 2;
  const SkinWeights weights = computeSkinWeights(mesh, skeleton, SkinMethod::kIdw);
  float raw[4], sum = 0;
  for (int k = 0; k < 4; ++k) sum += raw[k] = 1 / (static_cast<float>((k + 1) * (k + 1)) + 0.01f);
  for (int k = 0; k < 4; ++k) {
    CHECK(weights.joints(0, k) == k);
    CHECK(weights.weights(0, k) == Approx(raw[k] / sum));
  }
  CHECK(weights.joints(2, 0) == 0);
  CHECK(weights.weights(2, 0) > 0.9999f);
}

TEST_CASE("bad tables of regions are refused with their place") {
  const auto complaint = [](const std::string& regions) {
    try {
      parseRegions(R"({"format": "skel-regions", "version": 1, "regions": [)" + regions + "]}", "r.json");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  CHECK(complaint(R"({"name": "a", "words": [], "mixes": []})") == "none");
  CHECK(complaint(R"({"name": "a", "words": [], "mixes": ["b"]})") ==
        "r.json: regions[0].mixes[0]: there is no region \"b\"");
  CHECK(complaint(R"({"name": "a", "words": ["x"], "mixes": []})").find("one region must have no words") !=
        std::string::npos);
  CHECK(complaint(R"({"name": "a", "words": [], "mixes": []}, {"name": "a", "words": ["x"], "mixes": []})") ==
        "r.json: regions[1].name: \"a\" is the name of two regions");
  CHECK(complaint(R"({"name": "a", "words": [], "mixes": [], "power": 0})").find("regions[0].power: ") !=
        std::string::npos);
  CHECK(complaint(R"({"name": "a", "words": [""], "mixes": []})")
            .find("regions[0].words[0]: must be one word of small letters") != std::string::npos);
}

TEST_CASE(
    "the elk at rest is the elk, one turn turns what is below, a mirrored elk moves as its mirror image") {
  const TriangleMesh& mesh = elkMesh();
  const Skeleton& skeleton = elkSkeleton();
  const SkinWeights weights = computeSkinWeights(mesh, skeleton, SkinMethod::kGeodesic);
  const auto turned = [](const Skeleton& s, const std::string& joint, const Eigen::AngleAxisf& turn) {
    std::vector<Eigen::Quaternionf> rotations(s.joints.size(), Eigen::Quaternionf::Identity());
    if (!joint.empty()) rotations[static_cast<std::size_t>(s.index(joint))] = turn;
    return posedFromRest(s, rotations);
  };
  const Eigen::AngleAxisf nod(0.5f, Eigen::Vector3f::UnitX());
  for (const Blending blending : {Blending::kLinear, Blending::kDualQuaternions}) {
    const Eigen::MatrixX3f rest = skinVertices(mesh.vertices, weights, turned(skeleton, "", nod), blending);
    CHECK((rest - mesh.vertices).cwiseAbs().maxCoeff() < 1e-6f);
    // Antlers turn about the head's joint, hooves stay.
    const Eigen::MatrixX3f posed =
        skinVertices(mesh.vertices, weights, turned(skeleton, "head", nod), blending);
    const Eigen::Vector3f pivot =
        skeleton.joints[static_cast<std::size_t>(skeleton.index("head"))].position.cast<float>();
    const MeshParts parts = partsOf(mesh);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
      const Eigen::Vector3f p = mesh.vertices.row(v), now = posed.row(v);
      if (parts.of_vertex[static_cast<std::size_t>(v)] > 0)
        REQUIRE((now - (pivot + nod * (p - pivot))).norm() < 2e-6f);
      if (p.y() < 0.5f) REQUIRE((now - p).norm() < 1e-6f);
    }
  }

  // Left becomes right, joint by joint.
  TriangleMesh mirrored = mesh;
  mirrored.vertices.col(0) *= -1;
  mirrored.triangles.col(1).swap(mirrored.triangles.col(2));
  Skeleton other = skeleton;
  for (Joint& joint : other.joints) {
    joint.position.x() *= -1;
    if (joint.tail) joint.tail->x() *= -1;
  }
  const SkinWeights of_mirrored = computeSkinWeights(mirrored, other, SkinMethod::kIdw);
  const SkinWeights of_elk = computeSkinWeights(mesh, skeleton, SkinMethod::kIdw);
  const Eigen::AngleAxisf swing(0.6f, Eigen::Vector3f(1, 2, 3).normalized()),
      swung(0.6f, Eigen::Vector3f(1, -2, -3).normalized());
  Eigen::MatrixX3f a = skinVertices(mesh.vertices, of_elk, turned(skeleton, "thigh_l", swing));
  a.col(0) *= -1;
  const Eigen::MatrixX3f b = skinVertices(mirrored.vertices, of_mirrored, turned(other, "thigh_l", swung));
  CHECK((a - b).cwiseAbs().maxCoeff() < 1e-5f);
}
