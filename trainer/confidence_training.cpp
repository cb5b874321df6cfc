#include "trainer/confidence_training.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <set>
#include <sstream>

#include "libskel/cli/number.h"
#include "libskel/cli/outputs.h"
#include "libskel/core/files.h"
#include "libskel/core/text.h"
#include "libskel/jointnet/joint_net.h"
#include "libskel/recognition/calibration.h"
#include "libskel/recognition/confidence_model.h"
#include "trainer/confidence_samples.h"
#include "trainer/confidence_table.h"
#include "trainer/hands.h"
#include "trainer/logistic_fit.h"
#include "trainer/twin_hands.h"
#include "trainer/writable_output.h"

namespace skel {
namespace {

std::vector<ConfidenceSample> readTable(const std::string& file) {
  std::vector<ConfidenceSample> samples = parseConfidenceTable(readFile(file), file);
  for (const ConfidenceSample& s : samples)
    if (std::count(s.evidence.counts.begin(), s.evidence.counts.end(), true) == 0)
      throw InputError(file, "has no joint that counts of \"" + s.drawing + "\"");
  return samples;
}

// How much a sample counts: figures are as people draw them far more often than disturbed.
double weightOf(const ConfidenceSample& sample) {
  constexpr double kDisturbed = .1;  // of .1, .3 and 1 it was the best calibrated on hands left out
  return sample.disturbance == Disturbance::kNone || sample.disturbance == Disturbance::kFound ? 1
                                                                                               : kDisturbed;
}

bool knowsAJoint(const ConfidenceSample& sample) {
  return std::any_of(sample.right.begin(), sample.right.end(), [](int right) { return right >= 0; });
}

using SampleList = std::vector<const ConfidenceSample*>;

ConfidenceModel learn(const SampleList& samples, int seed) {
  ConfidenceModel model;
  LogisticFitOptions options;
  options.seed = static_cast<std::uint64_t>(seed);
  Eigen::Index count = 0;
  for (const ConfidenceSample* s : samples)
    count += std::count_if(s->right.begin(), s->right.end(), [](int right) { return right >= 0; });
  Eigen::MatrixXd inputs(count, static_cast<Eigen::Index>(kJointInputs.size()));
  Eigen::VectorXd came_true(count), weights(count);
  count = 0;
  for (const ConfidenceSample* s : samples) {
    for (std::size_t j = 0; j < s->right.size(); ++j) {
      if (s->right[j] < 0) continue;
      inputs.row(count) = s->evidence.joints.row(static_cast<Eigen::Index>(j));
      came_true[count] = s->right[j];
      weights[count++] = weightOf(*s);
    }
  }
  model.joint = fitLogisticNet(inputs, came_true, weights, options);

  count = static_cast<Eigen::Index>(samples.size());
  inputs.resize(count, static_cast<Eigen::Index>(kFigureInputs.size() + kJointSummary.size()));
  came_true.resize(count), weights.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const ConfidenceSample& s = *samples[static_cast<std::size_t>(i)];
    inputs.row(i) = figureInputs(s.evidence, model.joint);
    came_true[i] = s.usable;
    weights[i] = weightOf(s);
  }
  // Figures are few: of them a weighted sum is all that can be learned.
  options.hidden = 0;
  options.decay = 1e-2;
  model.figure = fitLogisticNet(inputs, came_true, weights, options);
  return model;
}

struct Forecasts {
  std::vector<Forecast> figures, joints;

  void add(const ConfidenceSample& sample, double figure, const std::vector<double>& by_joint) {
    figures.push_back({figure, sample.usable});
    for (std::size_t j = 0; j < by_joint.size(); ++j)
      if (sample.right[j] >= 0) joints.push_back({by_joint[j], sample.right[j] == 1});
  }
  void print(const char* title) const {
    constexpr double kSure = .8;
    double sure = 0, right = 0;
    for (const Forecast& joint : joints)
      if (joint.probability >= kSure) ++sure, right += joint.came_true;
    std::printf(
        "%-24s usable: area under ROC %.3f, calibration error %.3f  joints: %.3f, %.3f; %.2f at >= .8, %.3f "
        "of "
        "them right\n",
        title, areaUnderRoc(figures), calibrationError(figures), areaUnderRoc(joints),
        calibrationError(joints), sure / std::max<double>(1, static_cast<double>(joints.size())),
        right / std::max(1., sure));
  }
};

// Learns from all hands but a fold's, and measures on that as drawn; the masses and likeness beside.
void crossValidate(const std::vector<ConfidenceSample>& samples, const Hands& hands, int folds, int seed) {
  std::vector<std::string> drawings;
  for (const ConfidenceSample& s : samples) drawings.push_back(s.drawing);
  const std::map<std::string, int> fold_of = foldOfDrawing(drawings, hands, folds);
  std::map<std::string, std::pair<Forecasts, Forecasts>> by_plan;  // learned, and the net's own
  for (int fold = 0; fold < folds; ++fold) {
    SampleList learned;
    for (const ConfidenceSample& s : samples)
      if (fold_of.at(s.drawing) != fold) learned.push_back(&s);
    if (std::none_of(learned.begin(), learned.end(), [](const auto* s) { return knowsAJoint(*s); })) continue;
    const ConfidenceModel model = learn(learned, seed);
    for (const ConfidenceSample& s : samples) {
      if (fold_of.at(s.drawing) != fold || s.disturbance != Disturbance::kNone) continue;
      const Confidences sure = confidencesOf(s.evidence, model);
      by_plan[s.body_plan].first.add(s, sure.figure, sure.joints);
      by_plan[s.body_plan].second.add(s, s.likeness, s.masses);
    }
  }
  std::printf("on hands left out (%d folds):\n", folds);
  for (const auto& [plan, forecasts] : by_plan) {
    forecasts.first.print(printable(plan).c_str());
    forecasts.second.print("  likeness and masses");
  }
}

}  // namespace

void bindConfidenceTrainingOptions(CLI::App& command, ConfidenceTrainingOptions& options) {
  for (const std::string_view plan : builtInJointNets().bodyPlans())
    command
        .add_option("--" + std::string(plan), options.drawings[std::string(plan)],
                    "Drawings of this body plan with known joints, which the net has not learned from")
        ->type_name("DIR")
        ->take_all();
  command.add_option("tables", options.tables, "What --table has written: is learned from as well")
      ->type_name("FILE");
  command
      .add_option("--first-hand", options.first_hand, "Drawings of the hands before this one are left out")
      ->type_name("NAME");
  command.add_option("-o,--output", options.output, "Weights file to write")
      ->check(outputFile("skel-confidence"));
  command.add_option("--table", options.table, "Writes what is learned from, one line a figure or joint")
      ->type_name("FILE")
      ->check(outputFile());
  command.add_option("--copies", options.copies, "So many of each random disturbance of a drawing")
      ->capture_default_str()
      ->check(numberIn(0, 100));
  bindLearningOptions(command, options);
}

ExitCode runConfidenceTraining(const ConfidenceTrainingOptions& options) {
  if (options.table.empty() && options.output.empty()) throw UsageError("-o FILE or --table FILE is needed");
  Hands hands = readHands(options.hands, options.first_hand);
  std::map<std::string, std::vector<JointedDrawing>> drawings;
  for (const auto& [plan, dirs] : options.drawings)
    for (JointedDrawing& drawing : findJointedDrawings(dirs))
      if (!hands.learned.contains(drawingName(drawing.image))) drawings[plan].push_back(std::move(drawing));
  std::vector<std::string> images;
  for (const auto& [plan, list] : drawings)
    for (const JointedDrawing& drawing : list) images.push_back(drawing.image);
  uniteTwins(images, options.output.empty() ? 0 : options.folds, hands);
  if (!options.output.empty()) ensureWritableFile(options.output);
  if (!options.table.empty()) ensureWritableFile(options.table);
  std::vector<ConfidenceSample> samples;
  for (const std::string& table : options.tables)
    for (ConfidenceSample& sample : readTable(table)) samples.push_back(std::move(sample));
  for (const auto& [plan, list] : drawings) {
    std::vector<JointedDrawing> others;
    for (const auto& [other, other_list] : drawings)
      if (other != plan) others.insert(others.end(), other_list.begin(), other_list.end());
    for (ConfidenceSample& sample :
         confidenceSamples(list, others, builtInJointNets().of(plan), options.copies,
                           static_cast<std::uint64_t>(options.seed), options.threads))
      samples.push_back(std::move(sample));
  }
  if (samples.empty()) throw UsageError("there are no drawings to learn from; name some, see --help");
  if (!options.table.empty()) writeFile(options.table, formatConfidenceTable(samples));
  if (options.output.empty()) return ExitCode::kDone;
  if (std::none_of(samples.begin(), samples.end(), knowsAJoint))
    throw UsageError(
        "of no joint of these drawings it is known whether it is right; there is nothing to learn");
  if (options.folds > 1) crossValidate(samples, hands, options.folds, options.seed);
  SampleList all;
  for (const ConfidenceSample& sample : samples) all.push_back(&sample);
  ConfidenceModel model = learn(all, options.seed);
  std::set<std::string> names;
  for (const ConfidenceSample& sample : samples) names.insert(sample.drawing);
  model.provenance = "skel-train confidence --seed " + std::to_string(options.seed) + ": " +
                     std::to_string(samples.size()) + " looks at " + std::to_string(names.size()) +
                     " drawings";
  writeFile(options.output, formatConfidenceModel(model));
  std::printf("wrote %s\n", printable(options.output).c_str());
  return ExitCode::kDone;
}

}  // namespace skel
