// Limbs that cross the body: which pixels are theirs, and the bodies that become of them.
#include "libskel/layers/layer_map.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>
#include <numbers>

#include "libskel/core/error.h"
#include "libskel/core/segment.h"
#include "libskel/deform/measure_figure.h"
#include "libskel/image/mask_parts.h"
#include "libskel/image/read_image.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/layers/find_limbs.h"
#include "libskel/layers/held_things.h"
#include "libskel/layers/limb_net.h"
#include "libskel/mesh/fill_hidden.h"
#include "libskel/mesh/inflate.h"
#include "libskel/skeleton/lift.h"
#include "libskel/skin/skin_weights.h"
#include "tests/support/catch.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/synthetic_figure.h"

using namespace skel;

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Blue, the right arm orange with a black line around it: from the shoulder down the flank and across the
// belly.
struct Drawing {
  CapsuleFigure figure{.size = 400, .right_arm = 0, .right_forearm = -80};
  Skeleton skeleton = capsuleSkeleton(figure);
  SkeletonTemplate body_plan = loadTemplate("biped");
  Plane8 arm;  // 1 on the arm, its line included
  Image image;
  Silhouette silhouette;

  explicit Drawing(bool outlined = true,
                   CapsuleFigure of = {.size = 400, .right_arm = 0, .right_forearm = -80})
      : figure(of), image(capsuleImage(of)) {
    arm = Plane8::Zero(figure.size, figure.size);
    for (int y = 0; y < figure.size; ++y)
      for (int x = 0; x < figure.size; ++x) {
        const double distance = std::min(toBone(x, y, "right_shoulder", "right_elbow"),
                                         toBone(x, y, "right_elbow", "right_hand"));
        if (distance > figure.limb_radius) continue;
        arm(y, x) = 1;
        if (!outlined) continue;
        const bool line = distance > figure.limb_radius - 3;
        std::uint8_t* p = image.pixel(x, y);
        p[0] = line ? 20 : 240, p[1] = line ? 20 : 160, p[2] = line ? 20 : 60;
      }
    silhouette = silhouetteFromMask(capsuleMask(figure));
  }

  const Vector2d& at(const std::string& joint) const {
    return skeleton.joints[std::size_t(skeleton.index(joint))].image;
  }
  double toBone(int x, int y, const std::string& from, const std::string& to) const {
    return distanceToSegment<Vector2d>(Vector2d(x, y), at(from), at(to));
  }
  LayerMap layers() const { return findLayers(image, silhouette, skeleton, body_plan, builtInPartNet()); }
  std::vector<FigurePiece> pieces() const { return figurePieces(layers(), silhouette, skeleton, body_plan); }
  TriangleMesh mesh() const { return inflate(image, silhouette, {.back = Back::kPlain}, pieces()); }
};

// A mesh's triangles of one layer.
TriangleMesh onlyLayer(const TriangleMesh& mesh, int layer) {
  TriangleMesh part;
  std::vector<int> number(std::size_t(mesh.vertices.rows()), -1), rows;
  for (int v = 0; v < mesh.vertices.rows(); ++v)
    if (mesh.layer[v] == layer) number[std::size_t(v)] = int(rows.size()), rows.push_back(v);
  part.vertices = mesh.vertices(rows, Eigen::all);
  std::vector<Eigen::RowVector3i> triangles;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    if (mesh.layer[mesh.triangles(t, 0)] == layer)
      triangles.emplace_back(number[std::size_t(mesh.triangles(t, 0))],
                             number[std::size_t(mesh.triangles(t, 1))],
                             number[std::size_t(mesh.triangles(t, 2))]);
  part.triangles.resize(Eigen::Index(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) part.triangles.row(Eigen::Index(t)) = triangles[t];
  return part;
}

Vector3d corner(const Eigen::MatrixX3f& vertices, const TriangleMesh& mesh, Eigen::Index t, int k) {
  return vertices.row(mesh.triangles(t, k)).transpose().cast<double>();
}

// How far before and behind the drawing's plane a layer reaches at an image point.
std::pair<double, double> depthAt(const TriangleMesh& mesh, int layer, const Vector2d& image_point) {
  const Vector2d p = mesh.model_from_image(image_point);
  double low = 1e9, high = -1e9;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    if (mesh.layer[mesh.triangles(t, 0)] != layer) continue;
    const Vector3d a = corner(mesh.vertices, mesh, t, 0), b = corner(mesh.vertices, mesh, t, 1),
                   c = corner(mesh.vertices, mesh, t, 2);
    const auto cross = [](const Vector3d& u, const Vector3d& v) { return u.x() * v.y() - u.y() * v.x(); };
    const Vector3d q(p.x(), p.y(), 0);
    const double area = cross(b - a, c - a), u = cross(b - q, c - q) / area, v = cross(c - q, a - q) / area;
    if (!(u >= 0 && v >= 0 && u + v <= 1)) continue;
    const double z = u * a.z() + v * b.z() + (1 - u - v) * c.z();
    low = std::min(low, z), high = std::max(high, z);
  }
  return {low, high};
}

// The largest singular value of the map of any triangle.
double worstStretch(const TriangleMesh& mesh, const Eigen::MatrixX3f& posed) {
  double worst = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const auto edges = [&](const Eigen::MatrixX3f& vertices) {
      Eigen::Matrix<double, 3, 2> e;
      e << corner(vertices, mesh, t, 1) - corner(vertices, mesh, t, 0),
          corner(vertices, mesh, t, 2) - corner(vertices, mesh, t, 0);
      return e;
    };
    const Eigen::Matrix<double, 3, 2> rest = edges(mesh.vertices);
    const Eigen::Matrix3d map = edges(posed) * (rest.transpose() * rest).inverse() * rest.transpose();
    worst = std::max(worst, Eigen::JacobiSVD<Eigen::Matrix3d>(map).singularValues()[0]);
  }
  return worst;
}

// The arm turned about its shoulder by `degrees`.
Eigen::MatrixX3f raised(const TriangleMesh& mesh, const Skeleton& skeleton, const SkinWeights& weights,
                        double degrees) {
  const Vector3d shoulder = skeleton.joints[std::size_t(skeleton.index("right_shoulder"))].position;
  const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180, Vector3d::UnitZ());
  Eigen::MatrixX3f posed = mesh.vertices;
  for (Eigen::Index v = 0; v < posed.rows(); ++v) {
    double arm = 0;
    for (int k = 0; k < 4; ++k)
      for (const char* joint : {"right_shoulder", "right_elbow", "right_hand"})
        if (weights.weights(v, k) > 0 && weights.joints(v, k) == skeleton.index(joint))
          arm += double(weights.weights(v, k));
    const Vector3d p = mesh.vertices.row(v).transpose().cast<double>();
    posed.row(v) = ((1 - arm) * p + arm * (shoulder + turn * (p - shoulder))).transpose().cast<float>();
  }
  return posed;
}

// An animal of datasets with the joints and the mask that somebody has drawn.
struct Animal {
  SkeletonTemplate body_plan = loadTemplate("quadruped");
  Image image;
  Silhouette silhouette;
  Skeleton skeleton = presetSkeleton(body_plan, {0, 0}, {1, 1});
  LayerMap layers;

  explicit Animal(const std::string& name) {
    const std::string path = SKEL_SOURCE_DIR "/datasets/animals/" + name;
    image = readImage(path + ".png");
    silhouette = silhouetteFromMask(readMask(path + ".mask.png"));
    for (const auto& [joint, place] : readJointsFile(path + ".joints.json"))
      skeleton.joints[std::size_t(skeleton.index(joint))].image = *place;
    for (Joint& joint : skeleton.joints) joint.confidence = 1;
    layers = findLayers(image, silhouette, skeleton, body_plan, builtInPartNet());
  }
  // Of a limb, from the trunk outwards.
  Eigen::Vector2i joint(int limb, int i) const {
    const int of_plan = body_plan.limbs[std::size_t(limb)].joints[std::size_t(i)];
    const std::string& name = body_plan.joints[std::size_t(of_plan)].name;
    return skeleton.joints[std::size_t(skeleton.index(name))].image.array().round().matrix().cast<int>();
  }
  std::vector<FigurePiece> pieces() const { return figurePieces(layers, silhouette, skeleton, body_plan); }
};

}  // namespace

TEST_CASE(
    "an arm drawn before the chest is a layer, pixel by pixel, its outline with it, and nothing else is") {
  const Drawing drawing;
  const LayerMap layers = drawing.layers();
  REQUIRE(layers.any());
  const Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> right_arm = layers.limb == 1,
                                                                            truth = drawing.arm != 0;
  const double both = double((right_arm && truth).count()), either = double((right_arm || truth).count());
  CHECK(both / either > 0.85);
  CHECK((layers.limb > 1).count() == 0);
  CHECK(((layers.limb != 0) && (drawing.silhouette.mask == 0)).count() == 0);
}

TEST_CASE("a body plan with other limbs than two arms and two legs is one skin") {
  Drawing drawing;
  drawing.body_plan.limbs.pop_back();
  const LayerMap layers = drawing.layers();
  CHECK_FALSE(layers.any());
  CHECK(layers.hidden.empty());
}

TEST_CASE("in one piece an arm that was a layer is at rest, and moves nothing of the body it lies on") {
  const Drawing drawing;
  const LayerMap cut = drawing.layers(), whole = inOnePiece(cut, drawing.body_plan);
  REQUIRE(cut.any());
  CHECK_FALSE(whole.any());
  CHECK(whole.at_rest == std::vector<int>{1});
  CHECK(whole.hidden == std::vector<int>{1});
  CHECK((whole.part == cut.part).all());
  CHECK(figurePieces(whole, drawing.silhouette, drawing.skeleton, drawing.body_plan).empty());
  const TriangleMesh mesh = inflate(drawing.image, drawing.silhouette);
  const std::vector<int> joint_layers = jointLayers(drawing.skeleton, drawing.body_plan, mesh, whole);
  CHECK(joint_layers[std::size_t(drawing.skeleton.index("right_hand"))] == -1);
  CHECK(joint_layers[std::size_t(drawing.skeleton.index("left_hand"))] == 0);
  const Drawing free(false, CapsuleFigure{.size = 400});
  CHECK(inOnePiece(free.layers(), free.body_plan).at_rest.empty());
}

TEST_CASE("legs that were layers move with the body's skin in one piece") {
  const Animal sheep("cloud_sheep");
  REQUIRE(sheep.layers.any());
  const LayerMap whole = inOnePiece(sheep.layers, sheep.body_plan);
  CHECK_FALSE(whole.any());
  CHECK(whole.at_rest.empty());
  CHECK(whole.hidden.empty());
  CHECK(whole.far == sheep.layers.far);
}

TEST_CASE("free limbs, and those that nothing tells from the body, are no layers") {
  CHECK_FALSE(Drawing(false, CapsuleFigure{.size = 400}).layers().any());
  CHECK_FALSE(Drawing(false).layers().any());
  const Drawing drawing(false);
  CHECK(figurePieces(drawing.layers(), drawing.silhouette, drawing.skeleton, drawing.body_plan).empty());
}

TEST_CASE("each layer is a closed body, and the arm lies before the belly by its own thickness") {
  const Drawing drawing;
  const TriangleMesh mesh = drawing.mesh();
  REQUIRE(mesh.layer.size() == mesh.vertices.rows());
  CHECK(checkMesh(mesh).problem == "");
  CHECK(checkMesh(mesh).parts == 2);
  for (const int layer : {0, 1}) {
    CAPTURE(layer);
    const MeshReport report = checkMesh(onlyLayer(mesh, layer));
    CHECK(report.problem == "");
    CHECK(report.parts == 1);
    CHECK(report.euler == 2);
  }
  const Vector2d forearm = 0.4 * drawing.at("right_elbow") + 0.6 * drawing.at("right_hand");
  const auto body = depthAt(mesh, 0, forearm), arm = depthAt(mesh, 1, forearm);
  CHECK(body.second > 0.03);
  CHECK(arm.first > body.second - 0.005);
  CHECK(arm.second > arm.first + 0.03);
  // From the front the figure is as wide and high as it was drawn.
  const TriangleMesh one_skin = inflate(drawing.image, drawing.silhouette);
  for (int axis : {0, 1}) {
    CHECK(mesh.vertices.col(axis).minCoeff() == Approx(one_skin.vertices.col(axis).minCoeff()).margin(0.01));
    CHECK(mesh.vertices.col(axis).maxCoeff() == Approx(one_skin.vertices.col(axis).maxCoeff()).margin(0.01));
  }
}

TEST_CASE("behind the arm the body wears the body's colour, the arm its own all over") {
  const Drawing drawing;
  const TriangleMesh mesh = drawing.mesh();
  int behind = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows() / 2; ++t) {
    const int layer = mesh.layer[mesh.triangles(t, 0)];
    const Vector3d middle = (corner(mesh.vertices, mesh, t, 0) + corner(mesh.vertices, mesh, t, 1) +
                             corner(mesh.vertices, mesh, t, 2)) /
                            3;
    const Vector2d p = mesh.model_from_image.inverse(middle.head<2>());
    const Eigen::RowVector2f uv = (mesh.uvOf(t, 0) + mesh.uvOf(t, 1) + mesh.uvOf(t, 2)) / 3;
    const std::uint8_t* color =
        mesh.texture.pixel(int(uv.x() * float(mesh.texture.width)), int(uv.y() * float(mesh.texture.height)));
    CAPTURE(p.transpose(), int(color[0]), int(color[1]), int(color[2]));
    const double to_forearm = drawing.toBone(int(p.x()), int(p.y()), "right_elbow", "right_hand");
    const bool at_root = (p - drawing.at("right_shoulder")).norm() < 40;
    if (layer == 0 && to_forearm < 12 && !at_root) {
      ++behind;
      CHECK(color[2] > color[0] + 60);
    }
    if (layer == 1 && to_forearm < 11 && !at_root) CHECK(color[2] <= color[0] + 60);
  }
  CHECK(behind > 20);
}

TEST_CASE("raising the arm stretches nothing: the chest stays where it is") {
  const Drawing drawing;
  const TriangleMesh mesh = drawing.mesh();
  Skeleton skeleton = drawing.skeleton;
  const std::vector<int> joint_layers = jointLayers(skeleton, drawing.body_plan, mesh);
  liftToModel(skeleton, mesh, joint_layers);
  CHECK(skeleton.joints[std::size_t(skeleton.index("right_hand"))].position.z() > 0.05);
  const SkinWeights weights = computeSkinWeights(mesh, skeleton, SkinMethod::kGeodesic, {}, joint_layers);
  CHECK(worstStretch(mesh, raised(mesh, skeleton, weights, -120)) < 3);

  const TriangleMesh one_skin = inflate(drawing.image, drawing.silhouette);
  Skeleton of_one = drawing.skeleton;
  liftToModel(of_one, one_skin);
  const SkinWeights torn = computeSkinWeights(one_skin, of_one, SkinMethod::kGeodesic);
  CHECK(worstStretch(one_skin, raised(one_skin, of_one, torn, -120)) > 3);
}

TEST_CASE("an arm across the belly is free where it is a body of its own, else one piece with the body") {
  const Drawing drawing;
  const auto joined = [&](const TriangleMesh& mesh) {
    Skeleton skeleton = drawing.skeleton;
    const std::vector<int> joint_layers = jointLayers(skeleton, drawing.body_plan, mesh);
    liftToModel(skeleton, mesh, joint_layers);
    const SkinWeights weights = computeSkinWeights(mesh, skeleton, SkinMethod::kGeodesic, {}, joint_layers);
    return measureFigure(mesh, weights, skeleton).joined[std::size_t(skeleton.index("right_elbow"))];
  };
  CHECK(joined(drawing.mesh()) < 0.2);
  CHECK(joined(inflate(drawing.image, drawing.silhouette)) == 1);
}

TEST_CASE("an arm that leaves its hand with the body takes less than half of itself along") {
  const Drawing drawing;
  const TriangleMesh mesh = drawing.mesh();
  Skeleton skeleton = drawing.skeleton;
  const std::vector<int> joint_layers = jointLayers(skeleton, drawing.body_plan, mesh);
  liftToModel(skeleton, mesh, joint_layers);
  SkinWeights weights = computeSkinWeights(mesh, skeleton, SkinMethod::kGeodesic, {}, joint_layers);
  const auto taken = [&] {
    return measureFigure(mesh, weights, skeleton).taken[std::size_t(skeleton.index("right_elbow"))];
  };
  CHECK(taken() > 0.8);
  for (const char* name : {"right_elbow", "right_hand"})
    weights.joints = (weights.joints.array() == std::uint16_t(skeleton.index(name)))
                         .select(std::uint16_t(skeleton.index("body")), weights.joints);
  CHECK(taken() < 0.5);
}

TEST_CASE("an arm that nothing tells from the body, and whose hand is a guess, moves nothing") {
  Drawing drawing(false, {.size = 400, .right_arm = -30, .right_forearm = -30});
  CHECK(drawing.layers().hidden.empty());
  const std::size_t hand = std::size_t(drawing.skeleton.index("right_hand"));
  drawing.skeleton.joints[hand].confidence = .5;
  const LayerMap layers = drawing.layers();
  CHECK(layers.hidden == std::vector<int>{1});
  const TriangleMesh mesh = inflate(drawing.image, drawing.silhouette);
  const std::vector<int> joint_layers = jointLayers(drawing.skeleton, drawing.body_plan, mesh, layers);
  CHECK(joint_layers[hand] == -1);
  Skeleton skeleton = drawing.skeleton;
  liftToModel(skeleton, mesh, joint_layers);
  const SkinWeights weights = computeSkinWeights(mesh, skeleton, SkinMethod::kGeodesic, {}, joint_layers);
  for (const char* name : {"right_shoulder", "right_elbow", "right_hand"}) {
    const auto joint = std::uint16_t(skeleton.index(name));
    CHECK_FALSE((weights.joints.array() == joint && weights.weights.array() > 0).any());
  }
  CHECK(worstStretch(mesh, raised(mesh, skeleton, weights, -120)) < 1.01);
}

TEST_CASE("what two limbs cut off goes to the nearer of them: the rim of shoes that touch") {
  const std::string character = SKEL_SOURCE_DIR "/datasets/characters/box_robot";
  const SkeletonTemplate body_plan = loadTemplate("biped");
  const Image image = readImage(character + ".png");
  const Silhouette silhouette = silhouetteFromMask(readMask(character + ".mask.png"));
  Skeleton skeleton = presetSkeleton(body_plan, {0, 0}, {1, 1});
  for (const auto& [name, place] : readJointsFile(character + ".joints.json"))
    skeleton.joints[std::size_t(skeleton.index(name))].image = *place;
  for (Joint& joint : skeleton.joints) joint.confidence = 1;
  const LayerMap layers = findLayers(image, silhouette, skeleton, body_plan, builtInPartNet());
  REQUIRE(layers.any());
  for (const auto& [foot, limb] : {std::pair("right_foot", 3), std::pair("left_foot", 4)}) {
    const Vector2d& p = skeleton.joints[std::size_t(skeleton.index(foot))].image;
    auto sole = Eigen::Index(p.y());
    while (silhouette.mask(sole + 1, Eigen::Index(p.x())) != 0) ++sole;
    CHECK(int(layers.limb(sole, Eigen::Index(p.x()))) == limb);
  }
}

TEST_CASE("one leg of each pair of an animal is far: the trunk hides its root, and has nothing of it") {
  const Animal sheep("cloud_sheep");
  REQUIRE(sheep.layers.far.size() == 2);
  CHECK((sheep.layers.far[0] == 1 || sheep.layers.far[0] == 2));
  CHECK((sheep.layers.far[1] == 3 || sheep.layers.far[1] == 4));
  const std::vector<FigurePiece> pieces = sheep.pieces();
  REQUIRE(pieces.size() == 5);
  for (const FigurePiece& piece : pieces) {
    CAPTURE(piece.layer);
    const bool far =
        std::find(sheep.layers.far.begin(), sheep.layers.far.end(), piece.layer) != sheep.layers.far.end();
    CHECK(piece.behind == far);
    int hidden_by_trunk = 0, of_far = 0;
    for (int v = 0; v < piece.box.height(); ++v)
      for (int u = 0; u < piece.box.width(); ++u) {
        const int layer = sheep.layers.limb(piece.box.y0 + v, piece.box.x0 + u);
        hidden_by_trunk += piece.hidden(v, u) != 0 && layer == 0;
        of_far += piece.mask(v, u) != 0 && (layer == sheep.layers.far[0] || layer == sheep.layers.far[1]);
      }
    if (far) CHECK(hidden_by_trunk > 50);
    if (piece.layer == 0) CHECK(of_far == 0);
  }
}

TEST_CASE("a trunk before the legs keeps its outline, and legs keep theirs, all around") {
  const Animal sheep("cloud_sheep");
  for (int limb = 0; limb < 4; ++limb) {
    CAPTURE(limb);
    const Eigen::Vector2i knee = sheep.joint(limb, 1);
    REQUIRE(sheep.layers.limb(knee.y(), knee.x()) == limb + 1);
    int top = knee.y();
    while (sheep.layers.limb(top, knee.x()) == limb + 1) --top;
    int darkest = 255;
    for (int y = top - 4; y <= top; ++y) darkest = std::min<int>(darkest, sheep.image.pixel(knee.x(), y)[0]);
    CHECK(darkest < 60);
    for (const int step : {-1, 1})
      for (int x = knee.x(); sheep.silhouette.mask(knee.y(), x) != 0; x += step)
        CHECK(int(sheep.layers.limb(knee.y(), x)) == limb + 1);
  }
}

TEST_CASE("short legs reach their hips deep in the trunk") {
  const Animal pig("crayon_pig");
  int legs = 0;
  for (const FigurePiece& piece : pig.pieces()) {
    if (piece.layer == 0) continue;
    CAPTURE(piece.layer);
    const Eigen::Vector2i hip = pig.joint(piece.layer - 1, 0) - Eigen::Vector2i(piece.box.x0, piece.box.y0);
    REQUIRE(pig.layers.limb(hip.y() + piece.box.y0, hip.x() + piece.box.x0) == 0);
    CHECK(piece.mask(hip.y(), hip.x()) != 0);
    ++legs;
  }
  CHECK(legs >= 3);
}

TEST_CASE("an arm whose shoulder was found too far inside reaches it by a root as wide as itself") {
  Drawing drawing;
  LayerMap layers;
  layers.limb = (drawing.arm != 0 && drawing.silhouette.mask != 0).cast<std::uint8_t>();
  Vector2d& shoulder = drawing.skeleton.joints[std::size_t(drawing.skeleton.index("right_shoulder"))].image;
  shoulder += 2.5 * drawing.figure.limb_radius * (drawing.at("neck") - shoulder).normalized();
  const std::vector<FigurePiece> pieces =
      figurePieces(layers, drawing.silhouette, drawing.skeleton, drawing.body_plan);
  REQUIRE(pieces.size() == 2);
  const FigurePiece& arm = pieces[1];
  REQUIRE(layers.limb(int(shoulder.y()), int(shoulder.x())) == 0);
  for (const double angle : {0., 1.5, 3., 4.5}) {
    const Vector2d p =
        shoulder + .7 * drawing.figure.limb_radius * Vector2d(std::cos(angle), std::sin(angle));
    CAPTURE(p.transpose());
    CHECK(arm.mask(int(p.y()) - arm.box.y0, int(p.x()) - arm.box.x0) != 0);
  }
}

TEST_CASE("the parts of a mask are the 4-connected ones, numbered as they begin") {
  const auto masks = [](std::initializer_list<const char*> rows) {
    Plane8 mask(Eigen::Index(rows.size()), Eigen::Index(std::string(*rows.begin()).size()));
    Eigen::Index y = 0;
    for (const char* row : rows) {
      for (Eigen::Index x = 0; x < mask.cols(); ++x) mask(y, x) = row[x] == '#';
      ++y;
    }
    return mask;
  };
  CHECK(maskParts(Plane8::Zero(3, 4)).largest() == -1);
  CHECK(maskParts(Plane8::Zero(0, 0)).runs.empty());
  // A comb whose teeth meet below; corners that touch do not join.
  const MaskParts comb = maskParts(masks({"#.#.#", "#.#.#", "###..", ".....", "...##"}));
  CHECK(comb.size == std::vector<std::int64_t>{7, 2, 2});
  CHECK(comb.largest() == 0);
  const std::vector<int> parts = {0, 0, 1, 0, 0, 1, 0, 2};
  REQUIRE(comb.runs.size() == parts.size());
  for (std::size_t k = 0; k < parts.size(); ++k) CHECK(comb.runs[k].part == parts[k]);
}

TEST_CASE("pieces cover the figure, each in its own box, in any part of the picture") {
  const Drawing drawing;
  const std::vector<FigurePiece> pieces = drawing.pieces();
  REQUIRE(pieces.size() == 2);
  Plane8 bare = drawing.silhouette.mask;
  for (const FigurePiece& piece : pieces) {
    const Plane8* planes[] = {&piece.mask, &piece.hidden, &piece.over};
    for (const Plane8* plane : planes) {
      CHECK(plane->rows() == piece.box.height());
      CHECK(plane->cols() == piece.box.width());
    }
    CHECK(maskParts(piece.mask).size.size() == 1);
    for (int y = piece.box.y0; y < piece.box.y1; ++y)
      for (int x = piece.box.x0; x < piece.box.x1; ++x) {
        if (piece.mask(y - piece.box.y0, x - piece.box.x0) == 0) continue;
        REQUIRE(drawing.silhouette.mask(y, x) != 0);
        bare(y, x) = 0;
      }
  }
  CHECK_FALSE((bare != 0).any());
  // The arm takes no more room than it needs.
  CHECK(pieces[1].box.width() < pieces[0].box.width());
  CHECK(pieces[1].box.height() < pieces[0].box.height() / 2);
}

TEST_CASE("an arm that is seen of its forearm alone hangs on the shoulder all the same") {
  const Drawing drawing;
  LayerMap layers = drawing.layers();
  for (int y = 0; y < drawing.figure.size; ++y)
    for (int x = 0; x < drawing.figure.size; ++x)
      if (drawing.toBone(x, y, "right_shoulder", "right_elbow") < 2 * drawing.figure.limb_radius)
        layers.limb(y, x) = 0;
  const std::vector<FigurePiece> pieces =
      figurePieces(layers, drawing.silhouette, drawing.skeleton, drawing.body_plan);
  REQUIRE(pieces.size() == 2);
  const FigurePiece& arm = pieces[1];
  for (const char* joint : {"right_shoulder", "right_elbow", "right_hand"}) {
    const Vector2d p = drawing.at(joint);
    INFO(joint);
    CHECK(arm.mask(int(p.y()) - arm.box.y0, int(p.x()) - arm.box.x0) != 0);
  }
}

TEST_CASE("a map of layers survives its picture, and what is no map is refused") {
  const Drawing drawing;
  const LayerMap layers = drawing.layers();
  const Image picture = layerPicture(layers, drawing.silhouette.mask);
  CHECK(
      (layersOfPicture(picture, drawing.silhouette, drawing.body_plan, "map.png").limb == layers.limb).all());
  CHECK_FALSE(layersOfPicture(layerPicture({}, drawing.silhouette.mask), drawing.silhouette,
                              drawing.body_plan, "map.png")
                  .any());
  CHECK_THROWS_WITH(layersOfPicture(Image(30, 20), drawing.silhouette, drawing.body_plan, "map.png"),
                    "map.png: is a layer map of 30x20 px, the image has 400x400");
  Image wrong = picture;
  const Vector2d body = drawing.at("body");
  wrong.pixel(int(body.x()), int(body.y()))[0] = 7;
  const std::string pixel = std::to_string(int(body.x())) + ", " + std::to_string(int(body.y()));
  CHECK_THROWS_WITH(layersOfPicture(wrong, drawing.silhouette, drawing.body_plan, "map.png"),
                    "map.png: pixel (" + pixel +
                        ") has the colour (7, 150, 150), which is no limb's; paint with the colours that "
                        "--formats layers writes");
}

TEST_CASE("a limb that is one with the body is translucent in the picture, and stays one with it") {
  const Drawing drawing;
  LayerMap layers = drawing.layers();
  const Vector2d arm = drawing.at("right_elbow"), leg = drawing.at("left_knee");
  REQUIRE(layers.limb(int(arm.y()), int(arm.x())) == 1);
  REQUIRE(layers.limb(int(leg.y()), int(leg.x())) == 0);
  REQUIRE(layers.part(int(leg.y()), int(leg.x())) == std::uint8_t(Part::kLeftLeg));
  Image picture = layerPicture(layers, drawing.silhouette.mask);
  const auto pixelAt = [&](const Vector2d& p) {
    const std::uint8_t* c = picture.pixel(int(p.x()), int(p.y()));
    return std::array<int, 4>{c[0], c[1], c[2], c[3]};
  };
  CHECK(pixelAt(arm) == std::array{230, 60, 60, 255});
  CHECK(pixelAt(leg) == std::array{40, 170, 80, 170});
  const auto read = [&] {
    return layersOfPicture(picture, drawing.silhouette, drawing.body_plan, "map.png");
  };
  CHECK((read().limb == layers.limb).all());
  CHECK(read().part(int(leg.y()), int(leg.x())) == std::uint8_t(Part::kLeftLeg));
  CHECK((layerPicture(read(), drawing.silhouette.mask).rgba == picture.rgba).all());
  // Painted, it is a body of its own.
  picture.pixel(int(leg.x()), int(leg.y()))[3] = 255;
  CHECK(read().limb(int(leg.y()), int(leg.x())) == 4);
}

TEST_CASE("an arm along its bones is a limb, scraps beside bones that are a guess are none") {
  Drawing drawing;
  const auto chance = [&] {
    const auto found =
        findLimbs(drawing.image, drawing.silhouette, drawing.skeleton, drawing.body_plan, builtInPartNet());
    REQUIRE(found);
    const LimbEvidence arm = limbEvidence(*found, 0);
    REQUIRE(arm.area > 0);
    return builtInLimbNet().isLimb(arm);
  };
  CHECK(chance() > .8);
  // The shoulder and the elbow where the other arm is, the hand where it was.
  for (const char* joint : {"shoulder", "elbow"}) {
    Joint& wrong =
        drawing.skeleton.joints[std::size_t(drawing.skeleton.index("right_" + std::string(joint)))];
    wrong.image = drawing.at("left_" + std::string(joint));
    wrong.confidence = .3;
  }
  CHECK(chance() < .3);
  CHECK_FALSE((drawing.layers().limb == 1).any());
}

TEST_CASE("what speaks for a limb has a name each, and nothing speaks for one that is not there") {
  Drawing drawing;
  const auto found =
      findLimbs(drawing.image, drawing.silhouette, drawing.skeleton, drawing.body_plan, builtInPartNet());
  REQUIRE(found);
  for (int k = 0; k < 4; ++k) {
    const LimbEvidence limb = limbEvidence(*found, k);
    if (limb.area == 0) continue;
    REQUIRE(limb.inputs.size() == Eigen::Index(kLimbInputs.size()));
    CHECK(limb.inputs.allFinite());
  }
  CHECK(liesAgainst(found->borders[0]));
  CHECK(builtInLimbNet().isLimb(LimbEvidence{}) == 0);
}

TEST_CASE("a limb net of other inputs is refused") {
  const std::string text = formatLimbNet(builtInLimbNet());
  CHECK(formatLimbNet(parseLimbNet(text, "n.json")) == text);
  std::string other = text;
  other.replace(other.find("\"stout\""), 7, "\"thick\"");
  CHECK_THROWS_WITH(parseLimbNet(other, "n.json"),
                    Catch::Contains("n.json") && Catch::Contains("must be \"stout\""));
}

TEST_CASE("an arm whose hand is not told from the body is no body of its own: the hand would stay behind") {
  Drawing drawing;
  REQUIRE((drawing.layers().limb == 1).any());
  // The forearm is in a pocket: nothing is drawn of it.
  const Image blue = capsuleImage(drawing.figure);
  for (int y = 0; y < drawing.figure.size; ++y)
    for (int x = 0; x < drawing.figure.size; ++x)
      if (drawing.toBone(x, y, "right_elbow", "right_hand") <= drawing.figure.limb_radius + 1)
        std::copy_n(blue.pixel(x, y), 4, drawing.image.pixel(x, y));
  const LayerMap layers = drawing.layers();
  CHECK_FALSE((layers.limb == 1).any());
}

TEST_CASE(
    "a picture of layers shows skirts, hair, capes and things in colours of their own, which are no limbs") {
  const Drawing drawing;
  LayerMap layers = drawing.layers();
  layers.part = Plane8::Zero(drawing.figure.size, drawing.figure.size);
  const Vector2d body = drawing.at("body"), head = drawing.at("head");
  layers.part(int(body.y()), int(body.x())) = std::uint8_t(Part::kSkirt);
  layers.part(int(head.y()), int(head.x())) = std::uint8_t(Part::kThing);
  const Image picture = layerPicture(layers, drawing.silhouette.mask);
  const auto colorAt = [&](const Vector2d& p) {
    const std::uint8_t* c = picture.pixel(int(p.x()), int(p.y()));
    return std::array<std::uint8_t, 3>{c[0], c[1], c[2]};
  };
  CHECK(colorAt(body) == std::array<std::uint8_t, 3>{200, 110, 200});
  CHECK(colorAt(head) == std::array<std::uint8_t, 3>{60, 60, 100});
  CHECK(
      (layersOfPicture(picture, drawing.silhouette, drawing.body_plan, "map.png").limb == layers.limb).all());
}

TEST_CASE("a thing is of the limb that most of its border lies against, also where it was painted by hand") {
  const Drawing drawing;
  LayerMap layers = drawing.layers();
  const int arm = 1, trunk = 0;
  const Vector2d hand = drawing.at("right_hand"), neck = drawing.at("neck");
  layers.part = Plane8::Zero(drawing.figure.size, drawing.figure.size);
  const auto paint = [&](const Vector2d& at) {
    layers.part.block(int(at.y()) - 8, int(at.x()) - 8, 17, 17).setConstant(std::uint8_t(Part::kThing));
    layers.limb.block(int(at.y()) - 8, int(at.x()) - 8, 17, 17).setConstant(trunk);
  };
  paint(hand), paint(neck + Vector2d(0, 30));
  const LayerMap read = layersOfPicture(layerPicture(layers, drawing.silhouette.mask), drawing.silhouette,
                                        drawing.body_plan, "map.png");
  CHECK(read.limb(int(hand.y()), int(hand.x())) == arm);
  CHECK(read.limb(int(neck.y()) + 30, int(neck.x())) == trunk);
  CHECK(read.part(int(neck.y()) + 30, int(neck.x())) == std::uint8_t(Part::kThing));
  const LayerMap again = layersOfPicture(layerPicture(read, drawing.silhouette.mask), drawing.silhouette,
                                         drawing.body_plan, "map.png");
  CHECK((again.limb == read.limb).all());
  CHECK((again.part == read.part).all());
}

TEST_CASE(
    "what is called a cape, lies against nothing but a thing and is smaller is the rest of that thing") {
  Plane8 mask = Plane8::Zero(40, 40), part = mask;
  const auto draw = [&](int y, int x, int height, int width, Part what) {
    mask.block(y, x, height, width).setConstant(255);
    part.block(y, x, height, width).setConstant(std::uint8_t(what));
  };
  draw(20, 0, 20, 20, Part::kTrunk);
  draw(10, 22, 20, 4, Part::kThing);
  draw(4, 22, 6, 8, Part::kAppendix);     // a staff's knob
  draw(24, 20, 10, 2, Part::kAppendix);   // a cape, between the trunk and the thing
  draw(12, 26, 16, 10, Part::kAppendix);  // a wing, larger than the thing
  completeThings(mask, part);
  CHECK(int(part(6, 24)) == int(Part::kThing));
  CHECK(int(part(26, 20)) == int(Part::kAppendix));
  CHECK(int(part(14, 30)) == int(Part::kAppendix));
  CHECK(int(part(25, 10)) == int(Part::kTrunk));
}

TEST_CASE("pixels that skel itself had found apart from a limb were told as painted") {
  LayerMap layers;
  layers.limb = Plane8::Zero(10, 20);
  layers.limb.block(0, 0, 10, 8) = 2;
  layers.limb.block(2, 12, 3, 3) = 2;
  const Plane8 found = layers.limb;
  layers.limb.block(8, 18, 2, 2) = 2;
  CHECK(loosePixels(layers, 2) == 13);
  CHECK(loosePixels(layers, 2, found) == 4);
}

TEST_CASE("what is hidden takes the colours around it") {
  Image image(60, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) {
      const std::uint8_t color[4] = {std::uint8_t(x < 30 ? 200 : 20), 90, std::uint8_t(x < 30 ? 20 : 200),
                                     255};
      std::copy_n(color, 4, image.pixel(x, y));
    }
  Plane8 hidden = Plane8::Zero(40, 60);
  hidden.block(15, 0, 10, 60).setConstant(1);
  const Plane8 known = (hidden == 0).cast<std::uint8_t>();
  Image covered = image;
  for (int y = 15; y < 25; ++y)
    for (int x = 0; x < 60; ++x) std::fill_n(covered.pixel(x, y), 3, std::uint8_t{0});
  const Image filled = fillHidden(covered, known, hidden);
  for (const int x : {5, 25, 35, 55})
    for (int y = 15; y < 25; ++y) {
      CAPTURE(x, y);
      for (int c = 0; c < 3; ++c)
        CHECK(std::abs(int(filled.pixel(x, y)[c]) - int(image.pixel(x, y)[c])) <= 2);
    }
}
