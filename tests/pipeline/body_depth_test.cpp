// Each part of a drawn body is as deep as such parts are.
#include "libskel/pipeline/body_depth.h"

#include <algorithm>
#include <limits>
#include <string>

#include "libskel/image/read_image.h"
#include "libskel/layers/part_net.h"
#include "libskel/mesh/inflate.h"
#include "libskel/pipeline/rig_character.h"
#include "tests/support/catch.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/synthetic_figure.h"

using namespace skel;

namespace {

struct Extent {
  float low = std::numeric_limits<float>::infinity(), high = -low;
  void add(float value) { low = std::min(low, value), high = std::max(high, value); }
  float length() const { return high - low; }
};

// Of the vertices at that height, across (axis 0) or in depth (2), up to `reach` beside x.
Extent slice(const TriangleMesh& mesh, double y, int axis, double x = 0, double reach = 0.13) {
  Extent extent;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
    if (std::abs(double(mesh.vertices(v, 1)) - y) < 0.025 &&
        std::abs(double(mesh.vertices(v, 0)) - x) < reach)
      extent.add(mesh.vertices(v, axis));
  return extent;
}

struct Model {
  Skeleton skeleton;
  TriangleMesh mesh;
  Eigen::Vector2d at(const std::string& joint) const {
    return mesh.model_from_image(skeleton.joints[skeleton.index(joint)].image);
  }
};

Model capsuleModel() {
  CapsuleFigure figure;
  figure.right_arm = figure.left_arm = figure.right_forearm = figure.left_forearm = 70;
  const Silhouette silhouette = silhouetteFromMask(capsuleMask(figure));
  InflateOptions options;
  options.body = bodyDepth(capsuleSkeleton(figure), loadTemplate("biped"), silhouette);
  return {capsuleSkeleton(figure), inflate(capsuleImage(figure), silhouette, options)};
}

}  // namespace

TEST_CASE("a chest is shallower than wide, a head is round, the neck between them narrower") {
  const Model model = capsuleModel();
  CHECK(checkMesh(model.mesh).problem == "");
  const double body = model.at("body").y(), head = model.at("head").y();
  const float chest_width = slice(model.mesh, body, 0, 0, 0.3).length();
  const float chest = slice(model.mesh, body, 2).length();
  CHECK(chest < 0.85f * chest_width);
  CHECK(chest > 0.4f * chest_width);
  const float skull = slice(model.mesh, head, 2).length(), face = slice(model.mesh, head, 0, 0, 0.4).length();
  CHECK(skull > 0.8f * face);
  CHECK(skull < 1.1f * face);
  float neck = skull;
  for (double y = body; y < head; y += 0.01) neck = std::min(neck, slice(model.mesh, y, 2).length());
  CHECK(neck < 0.8f * skull);
  CHECK(neck < chest);
}

TEST_CASE(
    "trunks and skirts are as round as they are wide, capes are thin, and only on who faces the viewer") {
  const CapsuleFigure figure;
  // A skirt around the legs, a wing beside the trunk, both as pixels of the figure.
  Plane8 mask = capsuleMask(figure);
  Skeleton skeleton = capsuleSkeleton(figure);
  const auto joint = [&](const std::string& name) { return skeleton.joints[skeleton.index(name)].image; };
  const Eigen::Vector2d pelvis = joint("pelvis"), knee = joint("left_knee"), body = joint("body");
  Plane8 skirt = Plane8::Zero(mask.rows(), mask.cols()), wing = skirt;
  const int half = 70;
  skirt.block(int(pelvis.y()), int(pelvis.x()) - half, int(knee.y() - pelvis.y()), 2 * half)
      .setConstant(static_cast<std::uint8_t>(Part::kSkirt));
  wing.block(int(body.y()) - 30, int(body.x()), 60, 130)
      .setConstant(static_cast<std::uint8_t>(Part::kAppendix));
  mask = (skirt != 0 || wing != 0).select(Plane8::Constant(mask.rows(), mask.cols(), 255), mask);
  const Silhouette silhouette = silhouetteFromMask(mask);
  Image image(int(mask.cols()), int(mask.rows()));
  const auto modelWith = [&](const Plane8& parts) {
    InflateOptions options;
    options.body = bodyDepth(skeleton, loadTemplate("biped"), silhouette, {}, {}, parts);
    Model model{skeleton, inflate(image, silhouette, options)};
    CHECK(checkMesh(model.mesh).problem == "");
    return model;
  };
  const Model plain = modelWith({}), worn = modelWith(skirt.max(wing));
  const double hem = plain.mesh.model_from_image({pelvis.x(), 0.2 * pelvis.y() + 0.8 * knee.y()}).y();
  const float width = slice(worn.mesh, hem, 0, 0, 0.6).length();
  CHECK(slice(plain.mesh, hem, 2).length() < 0.6f * width);
  CHECK(slice(worn.mesh, hem, 2).length() == Approx(0.62f * width).epsilon(0.12));
  const Eigen::Vector2d tip = plain.mesh.model_from_image(body + Eigen::Vector2d(95, 0));
  const auto thick = [&](const Model& model) {
    return slice(model.mesh, tip.y(), 2, tip.x(), 0.05).length();
  };
  CHECK(thick(worn) < 0.6f * thick(plain));
  const BodyDepth from_side = [&] {
    skeleton.joints[skeleton.index("left_shoulder")].image = joint("right_shoulder");
    return bodyDepth(skeleton, loadTemplate("biped"), silhouette, {}, {}, skirt.max(wing));
  }();
  CHECK_FALSE(from_side.sections);
  CHECK_FALSE(from_side.capes);
  CHECK_FALSE(from_side.neck);
}

TEST_CASE("a neck that hair hides in front is narrow from the side") {
  const CapsuleFigure figure;
  Skeleton skeleton = capsuleSkeleton(figure);
  const Eigen::Vector2d neck = skeleton.joints[skeleton.index("neck")].image,
                        head = skeleton.joints[skeleton.index("head")].image;
  Plane8 mask = capsuleMask(figure);
  mask.block(int(head.y()), int(head.x()) - 60, int(neck.y() - head.y()) + 20, 120).setConstant(255);
  const Silhouette silhouette = silhouetteFromMask(mask);
  Image image(int(mask.cols()), int(mask.rows()));
  InflateOptions options;
  options.body = bodyDepth(skeleton, loadTemplate("biped"), silhouette);
  REQUIRE(options.body.neck);
  const auto narrowest = [&] {
    const TriangleMesh mesh = inflate(image, silhouette, options);
    CHECK(checkMesh(mesh).problem == "");
    const double throat = mesh.model_from_image(options.body.neck->at).y();
    return slice(mesh, throat, 2, mesh.model_from_image(neck).x()).length() /
           slice(mesh, mesh.model_from_image(head).y(), 2, mesh.model_from_image(head).x()).length();
  };
  const float with = narrowest();
  options.body.neck.reset();
  const float without = narrowest();
  CHECK(with < 0.75f);
  CHECK(with < 0.85f * without);
}

TEST_CASE("the rim lies forward on who faces the viewer, in the middle on who is drawn from the side") {
  const CapsuleFigure figure;
  const Silhouette silhouette = silhouetteFromMask(capsuleMask(figure));
  Skeleton skeleton = capsuleSkeleton(figure);
  for (const DepthBone& bone : bodyDepth(skeleton, loadTemplate("biped"), silhouette).bones)
    CHECK(bone.forward > 0.3);
  skeleton.joints[skeleton.index("left_shoulder")].image =
      skeleton.joints[skeleton.index("right_shoulder")].image;
  for (const DepthBone& bone : bodyDepth(skeleton, loadTemplate("biped"), silhouette).bones)
    CHECK(bone.forward == 0);
}

TEST_CASE(
    "legs of who is drawn from the side stand apart, the farther one behind, of who faces the viewer not") {
  const CapsuleFigure figure;
  const Silhouette silhouette = silhouetteFromMask(capsuleMask(figure));
  Skeleton skeleton = capsuleSkeleton(figure);
  const SkeletonTemplate biped = loadTemplate("biped");
  const auto depthOfFoot = [&](const std::string& side, const std::vector<int>& far) {
    InflateOptions options;
    options.body = bodyDepth(skeleton, biped, silhouette, far);
    const Model model{skeleton, inflate(capsuleImage(figure), silhouette, options)};
    CHECK(checkMesh(model.mesh).problem == "");
    const Eigen::Vector2d foot = model.at(side + "_foot"), knee = model.at(side + "_knee");
    const Extent shin = slice(model.mesh, (foot.y() + knee.y()) / 2, 2, (foot.x() + knee.x()) / 2, 0.08);
    return (shin.low + shin.high) / 2;
  };
  CHECK(depthOfFoot("left", {}) == Approx(depthOfFoot("right", {})).margin(0.004));
  skeleton.joints[skeleton.index("left_shoulder")].image =
      skeleton.joints[skeleton.index("right_shoulder")].image;
  const auto limb = [&](const std::string& root) {
    for (std::size_t k = 0; k < biped.limbs.size(); ++k)
      if (biped.joints[std::size_t(biped.limbs[k].joints[0])].name == root) return int(k) + 1;
    return 0;
  };
  CHECK(depthOfFoot("left", {limb("left_hip")}) < depthOfFoot("right", {limb("left_hip")}) - 0.02f);
  CHECK(depthOfFoot("left", {limb("right_hip")}) > depthOfFoot("right", {limb("right_hip")}) + 0.02f);
}

TEST_CASE("head and trunk in one are as deep as a ball, down to the legs") {
  CapsuleFigure figure;
  figure.trunk_radius = 95;
  const Silhouette silhouette = silhouetteFromMask(capsuleMask(figure));
  InflateOptions options;
  options.body = bodyDepth(capsuleSkeleton(figure), loadTemplate("biped"), silhouette);
  const Model model{capsuleSkeleton(figure), inflate(capsuleImage(figure), silhouette, options)};
  const double middle = model.at("neck").y();
  const float deepest = slice(model.mesh, middle, 2).length();
  CHECK(deepest > 0.7f * slice(model.mesh, middle, 0, 0, 0.6).length());
  CHECK(slice(model.mesh, model.at("pelvis").y(), 2).length() > 0.8f * deepest);
}

TEST_CASE("feet have a flat sole on the ground and a length to the front") {
  const Model model = capsuleModel();
  for (const std::string side : {"left", "right"}) {
    const Eigen::Vector2d foot = model.at(side + "_foot"), knee = model.at(side + "_knee");
    const Extent shin = slice(model.mesh, (foot.y() + knee.y()) / 2, 2, (foot.x() + knee.x()) / 2, 0.08);
    Extent sole;
    for (Eigen::Index v = 0; v < model.mesh.vertices.rows(); ++v)
      if (model.mesh.vertices(v, 1) < 0.015f && std::abs(double(model.mesh.vertices(v, 0)) - foot.x()) < 0.08)
        sole.add(model.mesh.vertices(v, 2));
    CAPTURE(side);
    CHECK(sole.length() > 0.9f * shin.length());  // not a point
    CHECK(sole.high > 1.3f * shin.high);          // the toe
    CHECK(sole.high > -1.3f * sole.low);          // further than the heel
    CHECK(model.mesh.vertices.col(1).minCoeff() == Approx(0).margin(1e-6));
  }
}

TEST_CASE("without bones a figure is as round as its outline, and without a head nothing is said") {
  const CapsuleFigure figure;
  const Silhouette silhouette = silhouetteFromMask(capsuleMask(figure));
  Skeleton headless = capsuleSkeleton(figure);
  for (Joint& joint : headless.joints)
    if (joint.name == "head") joint.name = "lamp";
  const BodyDepth none = bodyDepth(headless, loadTemplate("biped"), silhouette);
  CHECK(none.bones.empty());
  CHECK(none.feet.empty());
  CHECK(depthAt({}, {10, 10}).most_px == 0);
}

TEST_CASE("a head that lies where the neck does has none") {
  const CapsuleFigure figure;
  const Silhouette silhouette = silhouetteFromMask(capsuleMask(figure));
  Skeleton skeleton = capsuleSkeleton(figure);
  CHECK(bodyDepth(skeleton, loadTemplate("biped"), silhouette).neck);
  skeleton.joints[skeleton.index("neck")].image = skeleton.joints[skeleton.index("head")].image;
  CHECK_FALSE(bodyDepth(skeleton, loadTemplate("biped"), silhouette).neck);
}

TEST_CASE("what lies beyond the flesh of all bones is thin") {
  DepthBone bone;
  bone.to = {100, 0};
  bone.radius_px = 10, bone.most_px = 20;
  CHECK(depthAt({bone}, {50, 5}).most_px == Approx(20));
  CHECK(depthAt({bone}, {50, 40}).most_px < 6);
  CHECK(depthAt({bone}, {50, 80}).most_px < depthAt({bone}, {50, 40}).most_px);
}

TEST_CASE("an animal's trunk is no wider than three quarters of its height") {
  const std::string name = GENERATE("walking_dog", "cloud_sheep", "trumpeting_elephant", "walking_fox");
  CAPTURE(name);
  RigInput input;
  input.image = readImage(SKEL_SOURCE_DIR "/datasets/animals/" + name + ".png");
  RigOptions options;
  options.body_plan = loadTemplate("quadruped");
  const RiggedDrawing drawing = rigCharacter(std::move(input), options);
  REQUIRE(drawing.found());
  const TriangleMesh& mesh = drawing.character.mesh;
  const Skeleton& skeleton = drawing.character.skeleton;
  const Eigen::Vector3d body = skeleton.joints[skeleton.index("body")].position;
  Extent width, height;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    if (std::abs(double(mesh.vertices(v, 0)) - body.x()) > 0.04) continue;
    if (mesh.layer.size() > 0 && mesh.layer[v] != 0) continue;
    width.add(mesh.vertices(v, 2)), height.add(mesh.vertices(v, 1));
  }
  CHECK(width.length() <= 0.75f * height.length());
  CHECK(width.length() >= 0.3f * height.length());
}
