#include "libskel/jointnet/tree_recognizer.h"

#include <cmath>

#include "libskel/figures/figure.h"
#include "tests/support/catch.h"

namespace skel {
namespace {

constexpr int kFigures = 40;
const JointNet& kNet = builtInJointNet("biped");
const NetJoints kJoints = netJoints(kNet.joints, loadTemplate("biped"));

bool isInside(const Plane8& mask, const Eigen::Vector2d& p) {
  const int x = static_cast<int>(std::lround(p.x())), y = static_cast<int>(std::lround(p.y()));
  return x >= 0 && y >= 0 && x < mask.cols() && y < mask.rows() && mask(y, x) != 0;
}

double shareWithin(const std::vector<Figure>& figures, const std::vector<TreeRecognition>& found,
                   double share) {
  double hits = 0;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    for (int j = 0; j < kJoints.count(); ++j) {
      hits += (found[i].joints[j].position - figures[i].joints[j]).norm() <= share * 128;
    }
  }
  return hits / static_cast<double>(figures.size() * kJoints.names.size());
}

std::vector<Figure> someFigures(std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Figure> figures;
  for (int i = 0; i < kFigures; ++i) figures.push_back(generateFigure(rng));
  return figures;
}

TEST_CASE("Joints of generated figures are found, all inside the figure") {
  const std::vector<Figure> figures = someFigures(1001);
  std::vector<TreeRecognition> found;
  for (const Figure& f : figures) {
    found.push_back(recognizeByJointNet(f.mask, f.look, kNet, kJoints));
    for (const TreeJoint& joint : found.back().joints) {
      CHECK(isInside(f.mask, joint.position));
      CHECK((joint.confidence >= 0 && joint.confidence <= 1));
    }
    CHECK((found.back().figure_confidence >= 0 && found.back().figure_confidence <= 1));
  }
  CHECK(shareWithin(figures, found, .1) > .8);
  CHECK(shareWithin(figures, found, .05) > .6);
}

TEST_CASE("The instruction sets agree within a tenth of a pixel") {
  for (const Figure& f : someFigures(1002)) {
    TreeRecognizerOptions options;
    options.try_orientations = false;
    options.instructions = InstructionSet::kBaseline;
    const TreeRecognition baseline = recognizeByJointNet(f.mask, f.look, kNet, kJoints, options);
    for (const InstructionSet set : kInstructionSets) {
      if (!hasInstructionSet(set)) continue;
      options.instructions = set;
      const TreeRecognition other = recognizeByJointNet(f.mask, f.look, kNet, kJoints, options);
      for (int j = 0; j < kJoints.count(); ++j) {
        INFO(instructionSetName(set) << " " << kJoints.names[j]);
        CHECK((other.joints[j].position - baseline.joints[j].position).norm() < .1);
      }
    }
  }
}

TEST_CASE("A mirrored figure has mirrored joints") {
  for (const Figure& f : someFigures(1003)) {
    const Plane8 mask = f.mask.rowwise().reverse();
    FigureLook look{f.look.lines.rowwise().reverse(), {}};
    for (std::size_t k = 0; k < 3; ++k) look.tones[k] = f.look.tones[k].rowwise().reverse();
    TreeRecognizerOptions options;
    options.try_orientations = false;
    const TreeRecognition a = recognizeByJointNet(f.mask, f.look, kNet, kJoints, options);
    const TreeRecognition b = recognizeByJointNet(mask, look, kNet, kJoints, options);
    for (int j = 0; j < kJoints.count(); ++j) {
      const Eigen::Vector2d p = b.joints[kJoints.mirrored[j]].position;
      const Eigen::Vector2d back(static_cast<double>(mask.cols()) - 1 - p.x(), p.y());
      INFO(kJoints.names[j]);
      // Two ways to the nearest point of the figure may be equally short: one cell of slack.
      CHECK((back - a.joints[j].position).norm() < 4);
    }
  }
}

TEST_CASE("Degenerate figures come out unsure and without a crash") {
  std::vector<Plane8> masks = {Plane8::Constant(1, 1, 255), Plane8::Constant(1, 128, 255),
                               Plane8::Constant(128, 1, 255), Plane8::Constant(128, 128, 255),
                               Plane8::Constant(60, 128, 255)};
  masks.push_back(Plane8::Constant(128, 128, 255));
  masks.back().block(1, 1, 126, 126) = 0;
  for (const Plane8& mask : masks) {
    const TreeRecognition r = recognizeByJointNet(mask, {}, kNet, kJoints);
    for (const TreeJoint& joint : r.joints) CHECK(isInside(mask, joint.position));
    INFO(mask.rows() << "×" << mask.cols());
    CHECK(r.figure_confidence < .5);
  }
}

}  // namespace
}  // namespace skel
