#include "libskel/jointnet/tree_recognizer.h"

#include <cmath>

#include "tests/support/catch.h"
#include "trainer/figures/figure.h"

namespace skel {
namespace {

constexpr int kFigures = 40;

// A built-in net with figures of its body plan; each in turn.
struct Subject {
  const JointNet& net;
  NetJoints joints;
  std::vector<Figure> figures;
};
Subject anySubject(std::uint64_t seed) {
  const std::string name(GENERATE(from_range(builtInJointNets().bodyPlans())));
  const JointNet& net = builtInJointNets().of(name);
  Subject subject{net, netJoints(net.joints, loadTemplate(name)), {}};
  FigureOptions options;
  options.body_plan = name;
  Rng rng(seed);
  for (int i = 0; i < kFigures; ++i) subject.figures.push_back(generateFigure(rng, options));
  return subject;
}

bool isInside(const Plane8& mask, const Eigen::Vector2d& p) {
  const int x = static_cast<int>(std::lround(p.x())), y = static_cast<int>(std::lround(p.y()));
  return x >= 0 && y >= 0 && x < mask.cols() && y < mask.rows() && mask(y, x) != 0;
}

double shareWithin(const std::vector<Figure>& figures, const std::vector<TreeRecognition>& found,
                   double share) {
  double hits = 0;
  const std::size_t joints = figures[0].joints.size();
  for (std::size_t i = 0; i < figures.size(); ++i) {
    for (std::size_t j = 0; j < joints; ++j) {
      hits += (found[i].joints[j].position - figures[i].joints[j]).norm() <= share * 128;
    }
  }
  return hits / static_cast<double>(figures.size() * joints);
}

TEST_CASE("Joints of generated figures are found, all inside the figure") {
  const auto [net, joints, figures] = anySubject(1001);
  std::vector<TreeRecognition> found;
  for (const Figure& f : figures) {
    found.push_back(recognizeByJointNet(f.mask, f.look, net, joints));
    for (const TreeJoint& joint : found.back().joints) {
      CHECK(isInside(f.mask, joint.position));
      CHECK((joint.mass >= 0 && joint.mass <= 1));
      CHECK((joint.rival >= 0 && joint.mass + joint.rival <= 1 + 1e-5));
      CHECK((joint.counterpart >= 0 && joint.counterpart <= 1));
      CHECK((joint.entropy >= 0 && joint.likelihood <= 0 && joint.disagreement >= 0));
    }
    CHECK((found.back().likeness >= 0 && found.back().likeness <= 1));
  }
  CHECK(shareWithin(figures, found, .1) > .8);
  CHECK(shareWithin(figures, found, .05) > .6);
}

TEST_CASE("The instruction sets agree within a tenth of a pixel") {
  const auto [net, joints, figures] = anySubject(1002);
  for (const Figure& f : figures) {
    TreeRecognizerOptions options;
    options.try_orientations = false;
    options.instructions = InstructionSet::kBaseline;
    const TreeRecognition baseline = recognizeByJointNet(f.mask, f.look, net, joints, options);
    for (const InstructionSet set : kInstructionSets) {
      if (!hasInstructionSet(set)) continue;
      options.instructions = set;
      const TreeRecognition other = recognizeByJointNet(f.mask, f.look, net, joints, options);
      for (int j = 0; j < joints.count(); ++j) {
        INFO(instructionSetName(set) << " " << joints.names[j]);
        CHECK((other.joints[j].position - baseline.joints[j].position).norm() < .1);
      }
    }
  }
}

TEST_CASE("A mirrored figure has mirrored joints") {
  const auto [net, joints, figures] = anySubject(1003);
  for (const Figure& f : figures) {
    const Plane8 mask = f.mask.rowwise().reverse();
    FigureLook look{f.look.lines.rowwise().reverse(), {}};
    for (std::size_t k = 0; k < 3; ++k) look.tones[k] = f.look.tones[k].rowwise().reverse();
    TreeRecognizerOptions options;
    options.try_orientations = false;
    const TreeRecognition a = recognizeByJointNet(f.mask, f.look, net, joints, options);
    const TreeRecognition b = recognizeByJointNet(mask, look, net, joints, options);
    for (int j = 0; j < joints.count(); ++j) {
      const Eigen::Vector2d p = b.joints[joints.mirrored[j]].position;
      const Eigen::Vector2d back(static_cast<double>(mask.cols()) - 1 - p.x(), p.y());
      INFO(joints.names[j]);
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
  const auto [net, joints, figures] = anySubject(1004);
  for (const Plane8& mask : masks) {
    const TreeRecognition r = recognizeByJointNet(mask, {}, net, joints);
    for (const TreeJoint& joint : r.joints) CHECK(isInside(mask, joint.position));
    INFO(mask.rows() << "×" << mask.cols());
    CHECK(r.likeness < .5);
  }
}

}  // namespace
}  // namespace skel
