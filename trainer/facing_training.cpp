#include "trainer/facing_training.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "libskel/cli/outputs.h"
#include "libskel/core/files.h"
#include "libskel/core/parallel.h"
#include "libskel/core/progress.h"
#include "libskel/core/text.h"
#include "libskel/image/read_image.h"
#include "libskel/jointnet/joint_net.h"
#include "libskel/recognition/facing_net.h"
#include "libskel/recognition/tree_recognition.h"
#include "trainer/cases.h"
#include "trainer/jointed_drawing.h"
#include "trainer/twin_hands.h"
#include "trainer/writable_output.h"

namespace skel {
namespace {

struct Seen {
  std::string drawing;
  int facing_deg = 0;
  FacingEvidence evidence;
};

// As a run of skel-infer sees it. Nothing where the figure is found turned: which way somebody who lies
// looks is asked of nobody.
std::optional<FacingEvidence> evidenceOf(const JointedDrawing& drawing, const SkeletonTemplate& body_plan) {
  const Image image = readImage(drawing.image);
  const Silhouette silhouette = silhouetteOf(image, drawing);
  const Recognition recognition =
      recognizeByTree(image, silhouette, body_plan, builtInJointNets().of(body_plan.name), {});
  if (recognition.turned_deg != 0) return std::nullopt;
  return facingEvidence(recognition.skeleton, silhouette, 0);
}

// As likely in a drawing as in its mirror image.
std::vector<Case> whetherRight(const std::vector<Seen>& all) {
  std::vector<Case> cases;
  for (const Seen& seen : all) {
    if (seen.facing_deg == 0) continue;
    const std::string group = std::abs(seen.facing_deg) == 90 ? "side" : "half";
    const bool right = seen.facing_deg > 0;
    cases.push_back({group, seen.drawing, seen.evidence.sided, right});
    cases.push_back({group, seen.drawing, -seen.evidence.sided, !right});
  }
  return cases;
}

std::vector<Case> whetherTurned(const std::vector<Seen>& all, int least_deg) {
  std::vector<Case> cases;
  for (const Seen& seen : all)
    cases.push_back({"all", seen.drawing, turnInputs(seen.evidence), std::abs(seen.facing_deg) >= least_deg});
  return cases;
}

LogisticNet learn(const char* what, const std::vector<Case>& cases, const Hands& hands,
                  const LearningOptions& options) {
  const auto print = [&](const std::string& title, const std::vector<Forecast>& forecasts) {
    const auto right = std::count_if(forecasts.begin(), forecasts.end(), [](const Forecast& one) {
      return (one.probability >= .5) == one.came_true;
    });
    std::printf("%-10s %-4s %5zu figures, %.3f right, area under ROC %.3f\n", what, title.c_str(),
                forecasts.size(), double(right) / double(forecasts.size()), areaUnderRoc(forecasts));
  };
  LogisticFitOptions fit;
  fit.hidden = 0;  // units bring nothing on hands left out
  return learnFromCases(cases, hands, options, print, fit);
}

}  // namespace

void bindFacingTrainingOptions(CLI::App& command, FacingTrainingOptions& options) {
  command
      .add_option("drawings", options.drawings,
                  "Drawings of people whose joints files say which way they look")
      ->type_name("DIR")
      ->required();
  command.add_option("-o,--output", options.output, "Weights file to write")
      ->capture_default_str()
      ->check(outputFile("skel-facing-net"));
  bindLearningOptions(command, options);
}

ExitCode runFacingTraining(const FacingTrainingOptions& options) {
  Hands hands = readHands(options.hands);
  std::vector<JointedDrawing> drawings = findJointedDrawings(options.drawings);
  // Of who is seen from behind there are too few.
  std::erase_if(drawings, [](const JointedDrawing& drawing) {
    return !drawing.facing_deg || std::abs(*drawing.facing_deg) > 90;
  });
  if (drawings.empty())
    throw UsageError("no joints file there says which way its figure looks (facing_deg, or view front)");
  std::vector<std::string> images;
  for (const JointedDrawing& drawing : drawings) images.push_back(drawing.image);
  uniteTwins(images, options.folds, hands);
  ensureWritableFile(options.output);
  const SkeletonTemplate body_plan = loadTemplate("biped");
  std::vector<std::optional<FacingEvidence>> evidence(drawings.size());
  ProgressBar progress("looking at drawings", drawings.size());
  parallelFor(drawings.size(), options.threads, [&](std::size_t i) {
    evidence[i] = evidenceOf(drawings[i], body_plan);
    progress.advance();
  });
  std::vector<Seen> all;
  for (std::size_t i = 0; i < drawings.size(); ++i)
    if (evidence[i])
      all.push_back({drawingName(drawings[i].image), *drawings[i].facing_deg, std::move(*evidence[i])});
  if (std::none_of(all.begin(), all.end(), [](const Seen& seen) { return seen.facing_deg != 0; }))
    throw UsageError("no figure of these drawings looks to a side; there is nothing to learn");
  FacingNet net;
  net.right = learn("right", whetherRight(all), hands, options);
  net.turned = learn("turned", whetherTurned(all, 45), hands, options);
  net.side = learn("side", whetherTurned(all, 90), hands, options);
  net.provenance = "skel-train facing --seed " + std::to_string(options.seed) + ": " +
                   std::to_string(all.size()) + " figures";
  writeFile(options.output, formatFacingNet(net));
  std::printf("wrote %s\n", printable(options.output).c_str());
  return ExitCode::kDone;
}

}  // namespace skel
