#include "libskel/skin/skin_weights.h"

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <set>

#include "libskel/core/json.h"
#include "libskel/image/read_image.h"
#include "libskel/mesh/inflate.h"
#include "libskel/skin/bones.h"
#include "tests/support/catch.h"
#include "tests/support/skin_checks.h"
#include "tests/support/synthetic_figure.h"

using namespace skel;

namespace {

void lift(Skeleton& skeleton, const ModelFromImage& model_from_image) {
  for (Joint& joint : skeleton.joints) {
    const Eigen::Vector2d p = model_from_image(joint.image);
    joint.position = {p.x(), p.y(), 0};
  }
}

struct Body {
  TriangleMesh mesh;
  Skeleton skeleton;
};

Body capsuleBody(const CapsuleFigure& figure) {
  Body body{inflate(capsuleImage(figure), silhouetteFromMask(capsuleMask(figure))), capsuleSkeleton(figure)};
  lift(body.skeleton, body.mesh.model_from_image);
  return body;
}

std::vector<CapsuleFigure> poses() {
  CapsuleFigure spread, hanging, raised, stick;
  hanging.right_arm = hanging.left_arm = 12, hanging.right_forearm = hanging.left_forearm = 10;
  hanging.trunk_radius = 20, hanging.right_thigh = hanging.left_thigh = 3;
  hanging.right_shin = hanging.left_shin = 3, hanging.limb_radius = 9;
  raised.right_arm = 120, raised.right_forearm = 170, raised.left_arm = 60, raised.left_forearm = 130;
  stick.limb_radius = 2, stick.trunk_radius = 3;
  return {spread, hanging, raised, stick};
}

void checkRows(const SkinWeights& weights, int joint_count, int max_influences) {
  for (Eigen::Index v = 0; v < weights.weights.rows(); ++v) {
    const auto row = weights.weights.row(v);
    REQUIRE(std::abs(row.sum() - 1) < 2e-7f * 4);
    std::set<int> joints;
    for (int k = 0; k < 4; ++k) {
      REQUIRE(row[k] >= 0);
      if (k > 0) REQUIRE(row[k] <= row[k - 1]);
      if (k >= max_influences) REQUIRE(row[k] == 0);
      if (row[k] == 0) {
        REQUIRE(weights.joints(v, k) == 0);
      } else {
        REQUIRE(weights.joints(v, k) < joint_count);
        REQUIRE(joints.insert(weights.joints(v, k)).second);
      }
    }
  }
}

}  // namespace

TEST_CASE("every method gives every vertex sorted weights that sum to 1") {
  const Body body = capsuleBody({});
  for (const SkinMethod method : skinMethods()) {
    for (int influences = 1; influences <= 4; ++influences) {
      INFO(skinMethodName(method) << ", " << influences);
      SkinOptions options;
      options.max_influences = influences;
      checkRows(computeSkinWeights(body.mesh, body.skeleton, method, options), 17, influences);
    }
  }
}

TEST_CASE("a figure of capsules bends like one") {
  int index = 0;
  for (const CapsuleFigure& figure : poses()) {
    const Body body = capsuleBody(figure);
    const SkinWeights weights = computeSkinWeights(body.mesh, body.skeleton, SkinMethod::kGeodesic);
    INFO("pose " << index++);
    CHECK(foreignShare(weights, body.skeleton) < 0.02);
    CHECK(largestEdgeChange(body.mesh, weights, body.skeleton) < 0.35f);
    for (const std::string joint : kBends) {
      for (int way = 0; way < 4; ++way) {
        INFO(joint << " bent, way " << way);
        CHECK(insideOut(body.mesh, weights, bent(body.skeleton, joint, way)) == 0);
      }
    }
    // Half way along a bone, its own joint carries nearly everything.
    const Eigen::MatrixXf dense = denseWeights(weights, body.skeleton);
    for (const std::string part : {"shoulder", "elbow", "hip", "knee"}) {
      for (const std::string side : {"left_", "right_"}) {
        const int j = body.skeleton.index(side + part);
        int child = j + 1;
        const Eigen::RowVector3f middle =
            (0.5 * (body.skeleton.joints[j].position + body.skeleton.joints[child].position))
                .transpose()
                .cast<float>();
        Eigen::Index nearest;  // in front of it
        (body.mesh.vertices.leftCols<2>().rowwise() - middle.head<2>())
            .rowwise()
            .squaredNorm()
            .minCoeff(&nearest);
        INFO(side + part);
        CHECK(dense(nearest, j) > 0.8f);
      }
    }
  }
}

TEST_CASE("the flank beside an arm goes with the trunk; by distance through the air it goes with the arm") {
  CapsuleFigure figure;
  figure.trunk_radius = 34, figure.limb_radius = 9;
  figure.left_arm = figure.left_forearm = 25;
  const Body body = capsuleBody(figure);
  const Eigen::Vector2d flank = body.mesh.model_from_image({199.5 + 34, 203});
  Eigen::Index vertex;
  (body.mesh.vertices.leftCols<2>().rowwise() - flank.cast<float>().transpose())
      .rowwise()
      .squaredNorm()
      .minCoeff(&vertex);
  const auto onArm = [&](SkinMethod method) {
    const SkinWeights weights = computeSkinWeights(body.mesh, body.skeleton, method);
    const Eigen::MatrixXf dense = denseWeights(weights, body.skeleton);
    float sum = 0;
    for (Eigen::Index j = 0; j < dense.cols(); ++j) {
      if (bipedLimb(body.skeleton.joints[j].name) == 0) sum += dense(vertex, j);
    }
    return sum;
  };
  CHECK(onArm(SkinMethod::kGeodesic) < 0.02f);
  CHECK(onArm(SkinMethod::kEuclidean) > 0.3f);
}

TEST_CASE("meshes that are open, in parts, or far from the bones get weights") {
  const Body body = capsuleBody({});
  for (const SkinMethod method : skinMethods()) {
    INFO(skinMethodName(method));
    // The front sheet alone.
    TriangleMesh open = body.mesh;
    open.triangles = body.mesh.triangles.topRows(body.mesh.triangles.rows() / 2).eval();
    checkRows(computeSkinWeights(open, body.skeleton, method), 17, 4);

    // A hat that floats, and a vertex that no triangle uses: as the nearest part.
    TriangleMesh parts = body.mesh;
    const int count = static_cast<int>(parts.vertices.rows());
    parts.vertices.conservativeResize(count + 4, 3);
    parts.vertices.bottomRows(4) << 0, 1.75f, 0, 0.1f, 1.75f, 0, 0, 1.85f, 0, 0, 2, 0;
    parts.triangles.conservativeResize(parts.triangles.rows() + 1, 3);
    parts.triangles.bottomRows(1) << count, count + 1, count + 2;
    const SkinWeights weights = computeSkinWeights(parts, body.skeleton, method);
    checkRows(weights, 17, 4);
    for (int v = count; v < count + 4; ++v) {
      const std::string& joint = body.skeleton.joints[weights.joints(v, 0)].name;
      CHECK((joint == "head" || joint == "head_top"));
    }

    // Bones beside the body, bones of no length, one joint alone.
    Skeleton aside = body.skeleton;
    for (Joint& joint : aside.joints) joint.position.x() += 5;
    checkRows(computeSkinWeights(body.mesh, aside, method), 17, 4);
    for (Joint& joint : aside.joints) joint.position.setZero();
    checkRows(computeSkinWeights(body.mesh, aside, method), 17, 4);
    aside.joints.resize(1);
    checkRows(computeSkinWeights(body.mesh, aside, method), 1, 4);
    CHECK(computeSkinWeights(TriangleMesh(), body.skeleton, method).weights.rows() == 0);

    // Triangles without area.
    TriangleMesh flat = body.mesh;
    flat.vertices.col(0).setZero();
    checkRows(computeSkinWeights(flat, body.skeleton, method), 17, 4);
    flat.vertices.setZero();
    checkRows(computeSkinWeights(flat, body.skeleton, method), 17, 4);
  }
}

TEST_CASE("a joint moves the segment to its child, a leaf a tip, the head its half of the neck") {
  Skeleton skeleton = capsuleSkeleton();
  lift(skeleton, ModelFromImage());
  const std::vector<Bone> bones = skeletonBones(skeleton);
  CHECK(bones.size() == 22);
  int tips = 0;
  for (const Bone& bone : bones) {
    const Joint& joint = skeleton.joints[bone.joint];
    bool leaf = true;
    for (const Joint& other : skeleton.joints) leaf = leaf && other.parent != bone.joint;
    if (leaf) {
      ++tips;
      CHECK(bone.from == joint.position.cast<float>());
      CHECK((bone.to - bone.from).norm() > 0);
    }
  }
  CHECK(tips == 5);
  const std::vector<int> limbs = jointLimbs(skeleton);
  CHECK(limbs[skeleton.index("body")] == -1);
  CHECK(limbs[skeleton.index("neck")] == -1);
  CHECK(limbs[skeleton.index("left_shoulder")] == limbs[skeleton.index("left_hand")]);
  CHECK(limbs[skeleton.index("left_shoulder")] != limbs[skeleton.index("right_shoulder")]);
}

TEST_CASE("real drawings: foreign weight, edges, bends") {
  const char* root = std::getenv("SKEL_EVAL_DIR");
  if (!root) {
    std::cout << "SKIPPED: SKEL_EVAL_DIR is not set\n";
    return;
  }
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(std::string(root) + "/characters")) {
    if (entry.path().filename() == "joints.json") files.insert(entry.path().parent_path().string());
  }
  int drawings = 0, foreign = 0, edges = 0, whole_bends = 0, bends = 0;
  for (const std::string& folder : files) {
    Skeleton skeleton = capsuleSkeleton();
    const JsonDocument document = JsonDocument::readFile(folder + "/joints.json");
    const JsonValue joints = document.root().at("joints");
    bool complete = true;
    for (Joint& joint : skeleton.joints) {
      const std::string& name = joint.name;
      if (name == "pelvis" || name == "body" || name == "neck" || name == "head_top") continue;
      const std::optional<JsonValue> at = joints.find(name);
      complete = complete && at && !at->isNull();
      if (!complete) break;
      const std::vector<double> xy = at->asNumbers(2);
      joint.image = {xy[0], xy[1]};
    }
    if (!complete) continue;
    const auto at = [&](const char* name) -> Eigen::Vector2d& {
      return skeleton.joints[skeleton.index(name)].image;
    };
    at("pelvis") = 0.5 * (at("left_hip") + at("right_hip"));
    at("neck") = 0.5 * (at("left_shoulder") + at("right_shoulder"));
    at("body") = 0.5 * (at("pelvis") + at("neck"));
    at("head_top") = at("head") + 0.8 * (at("head") - at("neck"));

    const TriangleMesh mesh =
        inflate(readImage(folder + "/image.png"), silhouetteFromMask(readMask(folder + "/mask.png")));
    lift(skeleton, mesh.model_from_image);
    const SkinWeights weights = computeSkinWeights(mesh, skeleton, SkinMethod::kGeodesic);
    INFO(folder);
    checkRows(weights, 17, 4);
    const double share = foreignShare(weights, skeleton);
    const float change = largestEdgeChange(mesh, weights, skeleton);
    int wrong = 0;
    for (const std::string joint : kBends) {
      for (int way = 0; way < 4; ++way) {
        const int count = insideOut(mesh, weights, bent(skeleton, joint, way));
        wrong += count;
        ++bends;
        whole_bends += count == 0;
      }
    }
    ++drawings;
    foreign += share <= 0.02;
    edges += change <= 0.35f;
    std::cout << std::filesystem::relative(folder, root).string() << ": foreign " << share << ", edge "
              << change << ", inside out " << wrong << " in 16 bends of " << mesh.triangles.rows() << "\n";
  }
  std::cout << drawings << " drawings: foreign weight <= 2 % in " << foreign << ", edges <= 0.35 in " << edges
            << ", " << whole_bends << " of " << bends << " bends without a triangle inside out\n";
  REQUIRE(drawings > 20);
  CHECK(foreign >= drawings - 1);
  CHECK(edges >= drawings - 1);
  CHECK(whole_bends >= bends - bends / 50);
}
