// The default recogniser against synthetic truth: figures of capsules in several poses, moved, turned,
// blemished.
#include "libskel/recognition/tree_recognition.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "libskel/core/error.h"
#include "libskel/core/rng.h"
#include "libskel/jointnet/net_joints.h"
#include "libskel/silhouette/working_grid.h"
#include "tests/support/catch.h"
#include "tests/support/synthetic_figure.h"
#include "trainer/figures/figure.h"

using namespace skel;
using Eigen::Vector2d;

namespace {

const JointNet& kNet = builtInJointNets().of("biped");

std::vector<CapsuleFigure> poses() {
  CapsuleFigure down, out, up, mixed, walking;
  down.right_arm = down.left_arm = 28, down.right_forearm = down.left_forearm = 20;
  out.right_arm = out.left_arm = out.right_forearm = out.left_forearm = 85;
  up.right_arm = up.left_arm = 120, up.right_forearm = up.left_forearm = 150;
  mixed.right_arm = 110, mixed.right_forearm = 160, mixed.left_arm = 40, mixed.left_forearm = 30;
  walking.right_thigh = 30, walking.left_thigh = 25, walking.right_shin = 30, walking.left_shin = 25;
  return {down, out, up, mixed, walking};
}

Image inkOn(const Plane8& mask) {
  Image image(static_cast<int>(mask.cols()), static_cast<int>(mask.rows()));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      std::fill_n(image.pixel(x, y), 4, static_cast<std::uint8_t>(mask(y, x) ? 90 : 255));
  image.rgba.col(3).setConstant(255);
  return image;
}

Recognition recognize(const Plane8& mask) {
  const Silhouette silhouette = silhouetteFromMask(mask);
  REQUIRE(silhouette.found());
  return recognizeByTree(inkOn(mask), silhouette, loadTemplate("biped"), kNet);
}

Vector2d at(const Recognition& recognition, const std::string& joint) {
  return recognition.skeleton.joints[static_cast<size_t>(recognition.skeleton.index(joint))].image;
}

// Share of the net's joints within a tenth of the figure's long side of where `moved` takes the true ones.
double shareRight(
    const CapsuleFigure& figure, const Recognition& recognition,
    const std::function<Vector2d(Vector2d)>& moved = [](Vector2d p) { return p; }, double scale = 1) {
  const Skeleton truth = capsuleSkeleton(figure);
  const double near_px = 0.1 * 330 * scale;
  int right = 0;
  for (const std::string& name : kNet.joints)
    right += (at(recognition, name) - moved(truth.joints[truth.index(name)].image)).norm() <= near_px;
  return right / static_cast<double>(kNet.joints.size());
}

bool liesOn(const Plane8& mask, const Recognition& recognition) {
  return std::all_of(recognition.skeleton.joints.begin(), recognition.skeleton.joints.end(),
                     [&](const Joint& joint) {
                       return mask(std::lround(joint.image.y()), std::lround(joint.image.x())) != 0;
                     });
}

}  // namespace

TEST_CASE("plain figures are found, whole and sure") {
  for (const CapsuleFigure& figure : poses()) {
    const Plane8 mask = capsuleMask(figure);
    const Recognition recognition = recognize(mask);
    CHECK(shareRight(figure, recognition) >= 13.0 / 14);
    CHECK(recognition.confidence >= 0.5);
    CHECK(recognition.missing.empty());
    CHECK(liesOn(mask, recognition));
  }
}

TEST_CASE("a shifted figure has shifted joints") {
  const CapsuleFigure figure = poses()[3];
  const Plane8 mask = capsuleMask(figure);
  Plane8 shifted = Plane8::Zero(mask.rows() + 90, mask.cols() + 170);
  shifted.block(33, 121, mask.rows(), mask.cols()) = mask;
  const Recognition here = recognize(mask), there = recognize(shifted);
  for (const std::string& name : kNet.joints)
    CHECK((at(there, name) - at(here, name) - Vector2d(121, 33)).norm() < 1);
}

TEST_CASE("a figure of another size has joints at the same places") {
  for (const int size : {160, 900}) {
    CapsuleFigure figure = poses()[1];
    const Recognition recognition = [&] {
      CapsuleFigure sized = figure;
      sized.size = size;
      return recognize(capsuleMask(sized));
    }();
    const double scale = size / 400.0;
    CHECK(shareRight(
              figure, recognition, [&](Vector2d p) { return Vector2d(p * scale); }, scale) >= 13.0 / 14);
  }
}

// The mask's box, two px for each of the working grid: a grid over the mirror image is the mirrored grid.
Plane8 onWholeGridPixels(const Plane8& mask) {
  const WorkingGrid grid = gridOver(mask);
  const Plane8 small = sampleMask(mask, grid);
  Plane8 out(2 * small.rows(), 2 * small.cols());
  for (Eigen::Index y = 0; y < out.rows(); ++y)
    for (Eigen::Index x = 0; x < out.cols(); ++x) out(y, x) = small(y / 2, x / 2);
  return out;
}

TEST_CASE("a mirrored figure has mirrored joints, left and right exchanged") {
  const std::vector<int> mirrored = netJoints(kNet.joints, loadTemplate("biped")).mirrored;
  for (const CapsuleFigure& figure : poses()) {
    const Plane8 mask = onWholeGridPixels(capsuleMask(figure)), reversed = mask.rowwise().reverse();
    const Recognition one = recognize(mask), other = recognize(reversed);
    const double last = static_cast<double>(mask.cols()) - 1;
    for (size_t j = 0; j < kNet.joints.size(); ++j) {
      const Vector2d p = at(one, kNet.joints[j]);
      const Vector2d q = at(other, kNet.joints[static_cast<size_t>(mirrored[j])]);
      CHECK((Vector2d(last - p.x(), p.y()) - q).norm() < 0.1);
    }
  }
}

TEST_CASE("figures on their side and on their head are turned back, and it is said") {
  for (const CapsuleFigure& figure : poses()) {
    Plane8 mask = capsuleMask(figure);
    const double last = static_cast<double>(mask.cols()) - 1;
    for (int quarter = 1; quarter <= 3; ++quarter) {
      mask = Plane8(mask.transpose().rowwise().reverse());
      const Recognition recognition = recognize(mask);
      const auto turned = [&](Vector2d p) {
        for (int k = 0; k < quarter; ++k) p = Vector2d(last - p.y(), p.x());
        return p;
      };
      CHECK(shareRight(figure, recognition, turned) >= 12.0 / 14);
      CHECK(std::any_of(recognition.warnings.begin(), recognition.warnings.end(), [](const std::string& w) {
        return w.starts_with("the figure is turned by ") && w.ends_with(" degrees");
      }));
      TreeRecognizerOptions upright;
      upright.try_orientations = false;
      const Recognition kept =
          recognizeByTree(inkOn(mask), silhouetteFromMask(mask), loadTemplate("biped"), kNet, upright);
      CHECK(std::none_of(kept.warnings.begin(), kept.warnings.end(),
                         [](const std::string& w) { return w.starts_with("the figure is turned by "); }));
    }
  }
}

TEST_CASE("noise on the outline and holes do not matter") {
  Rng rng(23);
  for (const CapsuleFigure& figure : poses()) {
    Plane8 mask = capsuleMask(figure);
    for (int k = 0; k < 250; ++k) {
      // A bite or a bump of 2 to 5 px at the outline.
      const int x = 10 + static_cast<int>(rng.below(380)), y = 10 + static_cast<int>(rng.below(380));
      const int r = 2 + static_cast<int>(rng.below(4));
      const auto around = mask.block(y - r, x - r, 2 * r, 2 * r);
      if ((around > 0).any() && (around == 0).any())
        mask.block(y - r, x - r, 2 * r, 2 * r) = rng.chance(0.5) ? 255 : 0;
    }
    for (int k = 0; k < 3; ++k) mask.block(160 + 25 * k, 185 + 8 * k, 12, 14).setZero();
    CHECK(shareRight(figure, recognize(mask)) >= 12.0 / 14);
  }
}

TEST_CASE("a limb that is missing is named") {
  CapsuleFigure figure = poses()[1];
  Plane8 mask = capsuleMask(figure);
  mask.block(100, 245, 130, 155).setZero();  // the whole left arm
  const Recognition recognition = recognize(mask);
  const auto missing = [&](const std::string& joint) {
    return std::count(recognition.missing.begin(), recognition.missing.end(), joint) > 0;
  };
  CHECK((missing("left_hand") || missing("left_elbow")));
  CHECK_FALSE(missing("right_hand"));
  CHECK_FALSE(missing("head"));
}

TEST_CASE(
    "missing joints are named in a note, whatever the figure's confidence, and a good figure gets none") {
  const Plane8 whole = capsuleMask(poses()[1]);
  Plane8 armless = whole;
  armless.block(100, 245, 130, 155).setZero();
  bool whole_with_missing = false;
  for (const Plane8& mask : {whole, armless, Plane8(whole.topRows(240))}) {
    const Recognition recognition = recognize(mask);
    std::string said;
    for (const std::string& warning : recognition.warnings) said += warning + "\n";
    for (const std::string& joint : recognition.missing) CHECK(said.find(joint) != std::string::npos);
    if (recognition.confidence >= 0.5 && recognition.missing.empty()) CHECK(recognition.warnings.empty());
    whole_with_missing |= recognition.likeness >= 0.5 && !recognition.missing.empty();
  }
  CHECK(whole_with_missing);
}

TEST_CASE("a figure that the picture's border cuts is no sure figure") {
  const Plane8 whole = capsuleMask(poses()[0]);
  // Below the hips there is nothing; then a crop that only just takes the soles off.
  const Plane8 cut = whole.topRows(240), tight = whole.topRows(385);
  CHECK(recognize(cut).confidence < 0.5);
  CHECK(recognize(cut).warnings.front().starts_with("this hardly looks like one whole biped"));
  CHECK(recognize(tight).confidence >= 0.5);
}

TEST_CASE("of what hardly looks like a figure no joints are sure to be right") {
  for (const auto& [rows, columns] : {std::pair{20, 20}, {10, 300}, {300, 10}, {200, 300}}) {
    Plane8 mask = Plane8::Zero(rows + 40, columns + 40);
    mask.block(20, 20, rows, columns).setConstant(255);
    const Recognition recognition = recognize(mask);
    INFO(rows << "×" << columns);
    CHECK(recognition.likeness < 0.5);
    CHECK(recognition.confidence < 0.5);
    REQUIRE(!recognition.warnings.empty());
    CHECK(recognition.warnings.front().starts_with("this hardly looks like one whole biped"));
  }
}

TEST_CASE("an arm that is closed off against the body is found all the same") {
  CapsuleFigure figure = poses()[0];
  Plane8 mask = capsuleMask(figure);
  // Fill what lies between arm and trunk, down to the hand.
  const Skeleton truth = capsuleSkeleton(figure);
  const Vector2d hand = truth.joints[truth.index("left_hand")].image;
  for (int y = 140; y < hand.y(); ++y) {
    int last = 200;
    for (int x = 200; x < mask.cols(); ++x)
      if (mask(y, x)) last = x;
    mask.row(y).segment(200, last - 200).setConstant(255);
  }
  const Recognition recognition = recognize(mask);
  CHECK((at(recognition, "left_hand") - hand).norm() < 0.15 * 330);
  CHECK(shareRight(figure, recognition) >= 11.0 / 14);
}

TEST_CASE("a body plan that the net does not know is refused") {
  SkeletonTemplate other = loadTemplate("biped");
  for (TemplateJoint& joint : other.joints)
    if (joint.name == "left_hand") joint.name = "left_paw";
  other.name = "cat";
  const Plane8 mask = capsuleMask();
  CHECK_THROWS_WITH(recognizeByTree(inkOn(mask), silhouetteFromMask(mask), other, kNet),
                    "the template \"cat\" has no joint \"left_hand\" that could be found in a drawing");
}

// A generated animal as a drawing: its mask enlarged, in a picture with some room around it.
namespace {

struct DrawnAnimal {
  Plane8 mask;
  std::vector<Vector2d> joints;  // image px
  std::vector<bool> absent;      // joints that it has none of
};

DrawnAnimal drawn(const Figure& figure, int scale, int left, int top) {
  const Eigen::Index rows = figure.mask.rows(), cols = figure.mask.cols();
  DrawnAnimal animal;
  animal.absent = figure.absent;
  animal.mask = Plane8::Zero(rows * scale + top + 20, cols * scale + left + 20);
  for (Eigen::Index y = 0; y < rows; ++y)
    for (Eigen::Index x = 0; x < cols; ++x)
      animal.mask.block(top + y * scale, left + x * scale, scale, scale).setConstant(figure.mask(y, x));
  for (const Vector2d& p : figure.joints)
    animal.joints.push_back(p * scale + Vector2d::Constant((scale - 1) / 2.0) + Vector2d(left, top));
  return animal;
}

Recognition recognizeAnimal(const Plane8& mask) {
  return recognizeByTree(inkOn(mask), silhouetteFromMask(mask), loadTemplate("quadruped"),
                         builtInJointNets().of("quadruped"));
}

std::vector<Figure> someAnimals(int count) {
  Rng rng(77);
  FigureOptions options;
  options.body_plan = "quadruped";
  std::vector<Figure> animals;
  while (static_cast<int>(animals.size()) < count) animals.push_back(generateFigure(rng, options));
  return animals;
}

}  // namespace

TEST_CASE("animals are found, of any size and anywhere in the picture, mirrored ones mirrored") {
  const std::vector<std::string>& names = builtInJointNets().of("quadruped").joints;
  const std::vector<int> mirrored = netJoints(names, loadTemplate("quadruped")).mirrored;
  int right = 0, all = 0, sure_right = 0, sure = 0;  // joints; of figures of confidence >= 0.5
  const std::vector<Figure> animals = someAnimals(30);
  for (const Figure& figure : animals) {
    const DrawnAnimal animal = drawn(figure, 3, 20, 20), large = drawn(figure, 7, 130, 55);
    const Recognition here = recognizeAnimal(animal.mask), there = recognizeAnimal(large.mask),
                      back = recognizeAnimal(animal.mask.rowwise().reverse());
    CHECK(liesOn(animal.mask, here));
    const double last = static_cast<double>(animal.mask.cols()) - 1;
    for (size_t j = 0; j < names.size(); ++j) {
      if (animal.absent[j]) continue;
      ++all;
      const bool found = (at(here, names[j]) - animal.joints[j]).norm() <= 0.1 * 3 * 128;
      right += found;
      if (here.confidence >= 0.5) ++sure, sure_right += found;
      const Vector2d moved = (at(there, names[j]) - Vector2d(133, 58)) / 7 * 3 + Vector2d(21, 21);
      CHECK((moved - at(here, names[j])).norm() < 6);
      const Vector2d mirror = at(back, names[static_cast<size_t>(mirrored[j])]);
      if (here.confidence >= 0.5)
        CHECK((Vector2d(last - mirror.x(), mirror.y()) - at(here, names[j])).norm() < 12);
    }
  }
  CHECK(right >= 0.85 * all);
  CHECK(sure >= 0.3 * all);
  CHECK(sure_right >= 0.96 * sure);
}

TEST_CASE("a human is no sure animal, nor an animal a sure human") {
  int sure_animals = 0, sure_humans = 0;
  for (const CapsuleFigure& figure : poses())
    sure_animals += recognizeAnimal(capsuleMask(figure)).confidence >= 0.5;
  CHECK(sure_animals == 0);
  const std::vector<Figure> animals = someAnimals(30);
  for (const Figure& figure : animals)
    sure_humans += recognize(drawn(figure, 3, 20, 20).mask).confidence >= 0.5;
  CHECK(sure_humans <= 3);
}
