// What is said of how sure the recognition is: the numbers it follows from, their file, and what comes out.
#include <algorithm>
#include <cmath>

#include "libskel/core/error.h"
#include "libskel/core/rng.h"
#include "libskel/recognition/confidence_model.h"
#include "libskel/recognition/joint_note.h"
#include "tests/support/catch.h"
#include "tests/support/synthetic_figure.h"
#include "trainer/figures/figure.h"

using namespace skel;

namespace {

// Of generated figures of each built-in net.
std::vector<Evidence> someEvidence(int count) {
  std::vector<Evidence> all;
  for (const std::string_view name : builtInJointNets().bodyPlans()) {
    const JointNet& net = builtInJointNets().of(name);
    const SkeletonTemplate body_plan = loadTemplate(std::string(name));
    const NetJoints joints = netJoints(net.joints, body_plan);
    FigureOptions options;
    options.body_plan = name;
    Rng rng(4711);
    for (int i = 0; i < count; ++i) {
      const Figure figure = generateFigure(rng, options);
      all.push_back(evidenceOf(recognizeByJointNet(figure.mask, figure.look, net, joints), figure.mask, net,
                               joints, body_plan));
    }
  }
  return all;
}

LogisticNet someNet(Eigen::Index inputs, Eigen::Index hidden) {
  Rng rng(3);
  LogisticNet net;
  const auto fill = [&](auto& numbers) {
    for (double& n : numbers.reshaped()) n = rng.normal();
  };
  net.mean.resize(inputs), net.deviation.resize(inputs), net.direct.resize(inputs);
  net.hidden.resize(hidden, inputs), net.hidden_bias.resize(hidden), net.out.resize(hidden);
  fill(net.mean), fill(net.deviation), fill(net.direct), fill(net.hidden), fill(net.hidden_bias),
      fill(net.out);
  net.deviation = net.deviation.array().abs() + .1;
  net.bias = .25;
  return net;
}

ConfidenceModel someModel() {
  return {someNet(kJointInputs.size(), 3), someNet(kFigureInputs.size() + kJointSummary.size(), 2),
          "made up for a test"};
}

std::string complaint(const std::string& text) {
  try {
    parseConfidenceModel(text, "c.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  REQUIRE(text.find(what) != std::string::npos);
  return text.replace(text.find(what), what.size(), by);
}

}  // namespace

TEST_CASE("evidence is finite, and which joint it is stands once") {
  for (const Evidence& evidence : someEvidence(12)) {
    CHECK(evidence.joints.isFinite().all());
    CHECK(evidence.figure.isFinite().all());
    CHECK(evidence.joints.cols() == static_cast<Eigen::Index>(kJointInputs.size()));
    CHECK((evidence.joints.rightCols(9).rowwise().sum() == 1).all());
    // All but the tail's.
    const auto counted = std::count(evidence.counts.begin(), evidence.counts.end(), true);
    CHECK(counted == 14);
  }
}

TEST_CASE("evidence of degenerate figures is finite as well") {
  const JointNet& net = builtInJointNets().of("biped");
  const SkeletonTemplate body_plan = loadTemplate("biped");
  const NetJoints joints = netJoints(net.joints, body_plan);
  for (const auto& [rows, columns] : {std::pair{1, 1}, {1, 128}, {128, 1}, {128, 128}}) {
    const Plane8 mask = Plane8::Constant(rows, columns, 255);
    const Evidence evidence =
        evidenceOf(recognizeByJointNet(mask, {}, net, joints), mask, net, joints, body_plan);
    CHECK(evidence.joints.isFinite().all());
    CHECK(evidence.figure.isFinite().all());
    const Confidences sure = confidencesOf(evidence, builtInConfidenceModel());
    CHECK((sure.figure >= 0 && sure.figure <= 1));
  }
}

TEST_CASE("a joint that is wrong in more than one of three cases was called fine") {
  Recognition found;
  found.skeleton = presetSkeleton(loadTemplate("biped"), {0, 0}, {1, 1});
  for (Joint& joint : found.skeleton.joints) joint.origin = JointOrigin::kRecognized, joint.confidence = .9;
  found.confidence = found.likeness = .9;
  CHECK(jointNote(found, "biped").empty());
  Joint& hand = found.skeleton.joints[std::size_t(found.skeleton.index("right_hand"))];
  hand.confidence = .6;
  CHECK(jointNote(found, "biped") == "may be wrong, look at it: right_hand");
  found.missing = {"left_foot"};
  CHECK(jointNote(found, "biped") == "may be wrong, look at it: right_hand; not found: left_foot");
  hand.origin = JointOrigin::kCompleted;
  CHECK(jointNote(found, "biped") == "not found: left_foot (placed where it probably is)");
}

TEST_CASE("confidences are chances, and a file of the model gives the same again") {
  const ConfidenceModel model = someModel();
  const std::string text = formatConfidenceModel(model);
  const ConfidenceModel read = parseConfidenceModel(text, "c.json");
  CHECK(read.provenance == model.provenance);
  CHECK(formatConfidenceModel(read) == text);
  for (const Evidence& evidence : someEvidence(3)) {
    const Confidences one = confidencesOf(evidence, model), other = confidencesOf(evidence, read);
    CHECK(one.figure == other.figure);
    CHECK(one.joints == other.joints);
    CHECK((one.figure >= 0 && one.figure <= 1));
    CHECK(std::all_of(one.joints.begin(), one.joints.end(), [](double p) { return p >= 0 && p <= 1; }));
  }
}

TEST_CASE("a file that is no model of confidence is refused with the reason") {
  const std::string text = formatConfidenceModel(someModel());
  CHECK(complaint(replaced(text, "\"version\": 1", "\"version\": 2")).find("version") != std::string::npos);
  CHECK(complaint(replaced(text, "\"mass\"", "\"mess\"")) == "c.json: joint.inputs[0]: must be \"mass\"");
  CHECK(complaint(replaced(text, "\"mass\",", "")) ==
        "c.json: joint.inputs: has 28 names, this program knows 29");
  CHECK(complaint(replaced(text, "\"bias\": 0.25", "\"bias\": 1e9")).find("joint.bias") != std::string::npos);
  CHECK(complaint(replaced(text, "\"provenance\"", "\"source\"")).find("source") != std::string::npos);
  CHECK(complaint("{\"format\": \"skel-joint-net\"}").find("numbers that say how sure") != std::string::npos);
}
