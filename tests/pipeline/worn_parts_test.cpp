// Skirts, capes and things held move as such.
#include "libskel/pipeline/worn_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "libskel/mesh/inflate.h"
#include "libskel/skeleton/hanging.h"
#include "libskel/skeleton/lift.h"
#include "tests/support/catch.h"
#include "tests/support/synthetic_figure.h"

using namespace skel;

namespace {

// A capsule figure and what is drawn on it: rectangles of parts, which are figure, too.
struct Dressed {
  CapsuleFigure of;
  Plane8 mask = capsuleMask(of);
  LayerMap layers;
  TriangleMesh mesh;
  Skeleton skeleton = capsuleSkeleton(of);
  SkinWeights flesh, worn;

  explicit Dressed(const CapsuleFigure& figure = {}) : of(figure) {
    layers.part = Plane8::Zero(of.size, of.size);
  }

  Eigen::Vector2d at(const std::string& joint) const {
    return skeleton.joints[std::size_t(skeleton.index(joint))].image;
  }
  void draw(Part part, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
    const Eigen::Vector2i a = low.cast<int>(), size = (high - low).cast<int>();
    mask.block(a.y(), a.x(), size.y(), size.x()).setConstant(255);
    layers.part.block(a.y(), a.x(), size.y(), size.x()).setConstant(std::uint8_t(part));
  }
  void wear() {
    mesh = inflate(capsuleImage(of), silhouetteFromMask(mask), {});
    liftToModel(skeleton, mesh);
    flesh = worn = computeSkinWeights(mesh, skeleton, SkinMethod::kGeodesic);
    carryWornParts(mesh, loadTemplate("biped"), layers, skeleton, worn);
  }
  float share(const SkinWeights& weights, Eigen::Index v, const std::string& joint) const {
    float sum = 0;
    for (int k = 0; k < 4; ++k)
      if (weights.joints(v, k) == skeleton.index(joint)) sum += weights.weights(v, k);
    return sum;
  }
  // The vertex of the front that is drawn nearest to the point.
  Eigen::Index nearest(const Eigen::Vector2d& image) const {
    const Eigen::RowVector2f p = mesh.model_from_image(image).cast<float>().transpose();
    Eigen::Index best = 0;
    (mesh.vertices.leftCols<2>().rowwise() - p).rowwise().squaredNorm().minCoeff(&best);
    return best;
  }
  bool unchanged() const { return flesh.joints == worn.joints && flesh.weights == worn.weights; }
};

}  // namespace

TEST_CASE(
    "a skirt is pushed by both thighs, each on its side and more at its hem, and never bends at a knee") {
  Dressed figure;
  const Eigen::Vector2d pelvis = figure.at("pelvis"), knee = figure.at("left_knee");
  const double hem = knee.y() - 8;
  figure.draw(Part::kSkirt, {pelvis.x() - 60, pelvis.y()}, {pelvis.x() + 60, hem});
  figure.wear();
  const auto moved = [&](double x, double y, const std::string& joint) {
    return figure.share(figure.worn, figure.nearest({pelvis.x() + x, y}), joint);
  };
  CHECK(std::abs(moved(0, hem - 6, "left_hip") - moved(0, hem - 6, "right_hip")) < .1f);
  CHECK(moved(45, hem - 6, "left_hip") > 3 * moved(45, hem - 6, "right_hip"));
  CHECK(moved(-45, hem - 6, "right_hip") > 3 * moved(-45, hem - 6, "left_hip"));
  const auto trunk = [&](double y) {
    return moved(45, y, "pelvis") + moved(45, y, "hanging_skirt_1") + moved(45, y, "hanging_skirt_2");
  };
  CHECK(trunk(hem - 6) < .6f * trunk(pelvis.y() + 20));
  CHECK(moved(45, hem - 6, "left_hip") > .2f);
  for (const double x : {-45., 0., 45.}) {
    CHECK(moved(x, hem - 8, "left_knee") + moved(x, hem - 8, "right_knee") == 0);
    CHECK(moved(x, hem - 8, "pelvis") + moved(x, hem - 8, "hanging_skirt_2") > .1f);
  }
  // The shins below move as they did.
  const Eigen::Index foot = figure.nearest(figure.at("left_foot"));
  CHECK(figure.worn.weights.row(foot) == figure.flesh.weights.row(foot));
}

TEST_CASE("what is called a skirt but leaves the thighs apart moves as legs do") {
  Dressed figure;
  for (const std::string side : {"left", "right"}) {
    const Eigen::Vector2d hip = figure.at(side + "_hip"), knee = figure.at(side + "_knee");
    const Eigen::Vector2d middle = (hip + knee) / 2;
    figure.draw(Part::kSkirt, middle - Eigen::Vector2d(7, 20), middle + Eigen::Vector2d(7, 20));
  }
  figure.wear();
  CHECK(figure.unchanged());
}

TEST_CASE("a thing held rides rigidly with the arm whose hand holds it") {
  Dressed figure({.left_forearm = 0});
  const Eigen::Vector2d hand = figure.at("left_hand");
  figure.draw(Part::kThing, hand + Eigen::Vector2d(6, -60), hand + Eigen::Vector2d(36, 60));
  figure.wear();
  const Eigen::Index top = figure.nearest(hand + Eigen::Vector2d(28, -54));
  const Eigen::Index low = figure.nearest(hand + Eigen::Vector2d(28, 54));
  CHECK(figure.worn.weights.row(top) == figure.worn.weights.row(low));
  CHECK(figure.worn.joints.row(top) == figure.worn.joints.row(low));
  float arm = 0;
  for (const std::string joint : {"left_shoulder", "left_elbow", "left_hand"})
    arm += figure.share(figure.worn, top, joint);
  CHECK(arm > .99f);
  CHECK_FALSE(figure.flesh.weights.row(top) == figure.flesh.weights.row(low));
}

TEST_CASE("a staff that a hand is drawn before stays in one piece") {
  Dressed figure({.left_forearm = 0});
  const Eigen::Vector2d hand = figure.at("left_hand");
  figure.draw(Part::kThing, hand + Eigen::Vector2d(0, -70), hand + Eigen::Vector2d(24, -8));
  figure.draw(Part::kThing, hand + Eigen::Vector2d(0, 8), hand + Eigen::Vector2d(24, 70));
  figure.wear();
  const std::array<Eigen::Vector2d, 2> places = {hand + Eigen::Vector2d(12, -60),
                                                 hand + Eigen::Vector2d(12, 60)};
  const Eigen::Index first = figure.nearest(places[0]);
  for (const Eigen::Vector2d& place : places) {
    const Eigen::Index v = figure.nearest(place);
    CHECK(figure.worn.weights.row(v) == figure.worn.weights.row(first));
    CHECK(figure.worn.joints.row(v) == figure.worn.joints.row(first));
    CHECK_FALSE(figure.flesh.weights.row(v) == figure.worn.weights.row(v));
  }
}

TEST_CASE("a cape goes with the trunk, also where it hangs against a leg") {
  Dressed figure;
  const Eigen::Vector2d pelvis = figure.at("pelvis"), foot = figure.at("left_foot");
  figure.draw(Part::kAppendix, {pelvis.x() + 30, pelvis.y() - 60}, {pelvis.x() + 90, foot.y() - 20});
  figure.wear();
  const Eigen::Index hem = figure.nearest({pelvis.x() + 60, foot.y() - 30});
  const auto legs = [&](const SkinWeights& weights) {
    return figure.share(weights, hem, "left_hip") + figure.share(weights, hem, "left_knee") +
           figure.share(weights, hem, "left_foot");
  };
  CHECK(legs(figure.flesh) > .5f);
  CHECK(legs(figure.worn) == 0);
}

TEST_CASE("what hangs free is moved by a chain the more the farther it is from where it hangs") {
  Dressed figure;
  const Eigen::Vector2d pelvis = figure.at("pelvis"), foot = figure.at("left_foot");
  figure.draw(Part::kAppendix, {pelvis.x() + 30, pelvis.y() - 60}, {pelvis.x() + 120, foot.y() - 60});
  figure.wear();
  const int upper = figure.skeleton.find("hanging_cape_1"), lower = figure.skeleton.find("hanging_cape_2");
  REQUIRE(upper >= 0);
  REQUIRE(lower == upper + 1);
  CHECK(figure.skeleton.joints[std::size_t(lower)].parent == upper);
  const auto share = [&](double x, double y, const char* joint) {
    return figure.share(figure.worn, figure.nearest({pelvis.x() + x, y}), joint);
  };
  const double low = foot.y() - 66;
  CHECK(share(114, low, "hanging_cape_2") > .8f);
  CHECK(share(114, low, "hanging_cape_2") > 2 * share(80, pelvis.y(), "hanging_cape_2"));
  CHECK(share(44, pelvis.y() - 40, "hanging_cape_1") + share(44, pelvis.y() - 40, "hanging_cape_2") < .3f);
  for (Eigen::Index v = 0; v < figure.mesh.vertices.rows(); ++v)
    CHECK(figure.worn.weights.row(v).sum() == Approx(1).margin(1e-4));
}

TEST_CASE("what stands on the ground beside a figure, as a chair does, hangs on no chain") {
  Dressed figure;
  const Eigen::Vector2d pelvis = figure.at("pelvis"), foot = figure.at("left_foot");
  figure.draw(Part::kAppendix, {pelvis.x() + 30, pelvis.y() - 60}, {pelvis.x() + 120, foot.y() + 14});
  figure.wear();
  CHECK(std::none_of(figure.skeleton.joints.begin(), figure.skeleton.joints.end(), hangs));
}

TEST_CASE("crumbs of parts, and maps without parts, change nothing") {
  Dressed figure;
  const Eigen::Vector2d knee = figure.at("left_knee");
  figure.draw(Part::kThing, knee, knee + Eigen::Vector2d(4, 4));
  figure.wear();
  CHECK(figure.unchanged());
  SkinWeights weights = figure.flesh;
  carryWornParts(figure.mesh, loadTemplate("biped"), {}, figure.skeleton, weights);
  CHECK(weights.weights == figure.flesh.weights);
}
