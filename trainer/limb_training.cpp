#include "trainer/limb_training.h"

#include <algorithm>
#include <cstdio>
#include <opencv2/core.hpp>
#include <optional>

#include "libskel/cli/outputs.h"
#include "libskel/core/files.h"
#include "libskel/core/parallel.h"
#include "libskel/core/segment.h"
#include "libskel/core/text.h"
#include "libskel/image/read_image.h"
#include "libskel/jointnet/joint_net.h"
#include "libskel/layers/find_limbs.h"
#include "libskel/layers/limb_net.h"
#include "libskel/recognition/tree_recognition.h"
#include "trainer/cases.h"
#include "trainer/confidence_samples.h"
#include "trainer/hands.h"
#include "trainer/part_samples.h"
#include "trainer/twin_hands.h"
#include "trainer/writable_output.h"

namespace skel {
namespace {

// Of a limb that is one: intersection over union with the true limb, and of the true one's end, the pixels
// nearest to the last half of its last bone, what was found.
constexpr double kMet = .5, kEndMet = .5;

using Vec = Eigen::Vector2d;

bool isEnd(const std::array<Vec, 3>& bones, const Vec& p) {
  const Vec middle = (bones[1] + bones[2]) / 2;
  return distanceToSegment<Vec>(p, middle, bones[2]) <=
         std::min(distanceToSegment<Vec>(p, bones[0], bones[1]), distanceToSegment<Vec>(p, bones[1], middle));
}

// Which of the found limbs are true ones; the sides exchanged as a whole where they fit better so.
std::array<bool, 4> trueLimbs(const PartPicture& picture, const PartSample& truth) {
  std::array<std::array<int, 4>, 4> both{}, both_at_end{};
  std::array<int, 4> found{}, there{}, there_at_end{};
  for (int y = 0; y < picture.part.rows(); ++y)
    for (int x = 0; x < picture.part.cols(); ++x) {
      if (picture.mask(y, x) == 0) continue;
      const Vec at = Vec(x + .5, y + .5) / picture.scale + Vec(picture.box.x0, picture.box.y0);
      const int a = picture.part(y, x) - static_cast<int>(Part::kRightArm),
                b = truth.part.at<std::uint8_t>(int(at.y()), int(at.x())) - static_cast<int>(Part::kRightArm);
      const auto from = static_cast<std::size_t>(a), to = static_cast<std::size_t>(b);
      const bool limb_found = a >= 0 && a < 4, limb_there = b >= 0 && b < 4;
      const bool end = limb_there && isEnd(truth.skeleton.limbs[to], at);
      if (limb_found) ++found[from];
      if (limb_there) ++there[to], there_at_end[to] += end;
      if (limb_found && limb_there) ++both[from][to], both_at_end[from][to] += end;
    }
  const auto overlap = [&](std::size_t k, std::size_t other) {
    const int all = found[k] + there[other] - both[k][other];
    return all == 0 ? 0. : static_cast<double>(both[k][other]) / all;
  };
  double plain = 0, exchanged = 0;
  for (std::size_t k = 0; k < 4; ++k) plain += overlap(k, k), exchanged += overlap(k, k ^ 1);
  std::array<bool, 4> is_true{};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t other = plain >= exchanged ? k : k ^ 1;
    is_true[k] = overlap(k, other) >= kMet && both_at_end[k][other] >= kEndMet * there_at_end[other];
  }
  return is_true;
}

std::vector<Case> limbsOf(const JointedDrawing& drawing, const std::string& shapes) {
  const std::optional<PartSample> truth = readPartSample(drawing, shapes);
  if (!truth) return {};
  const Image image = readImage(drawing.image);
  const Silhouette silhouette = silhouetteOf(image, drawing);
  const std::string plan = truth->skeleton.animal ? "quadruped" : "biped";
  const SkeletonTemplate body_plan = loadTemplate(plan);
  const Recognition recognition =
      recognizeByTree(image, silhouette, body_plan, builtInJointNets().of(plan), {});
  const std::optional<FoundLimbs> found =
      findLimbs(image, silhouette, recognition.skeleton, body_plan, builtInPartNet());
  if (!found) return {};
  const std::array<bool, 4> is_true = trueLimbs(found->picture, *truth);
  std::vector<Case> cases;
  for (std::size_t k = 0; k < is_true.size(); ++k) {
    if (!liesAgainst(found->borders[k])) continue;
    const LimbEvidence evidence = limbEvidence(*found, static_cast<int>(k));
    const std::string pair = plan == "biped" ? (k < 2 ? "arms" : "legs") : "legs of animals";
    cases.push_back({pair, drawingName(drawing.image), evidence.inputs, is_true[k]});
  }
  return cases;
}

void printLimbs(const std::string& title, const std::vector<Forecast>& forecasts) {
  double kept = 0, limbs = 0, both = 0;
  for (const Forecast& limb : forecasts) {
    const bool is_kept = limb.probability >= kIsLimb;
    kept += is_kept;
    limbs += limb.came_true;
    both += is_kept && limb.came_true;
  }
  const auto count = static_cast<double>(forecasts.size());
  std::printf("%-16s %5.0f found, %5.0f are limbs: %3.0f %% of them kept, %3.0f %% of the others left out",
              title.c_str(), count, limbs, 100 * both / std::max(1., limbs),
              100 * (1 - (kept - both) / std::max(1., count - limbs)));
  std::printf(limbs > 0 && limbs < count ? "; area under ROC %.3f, calibration error %.3f\n" : "\n",
              areaUnderRoc(forecasts), calibrationError(forecasts));
}

}  // namespace

void bindLimbTrainingOptions(CLI::App& command, LimbTrainingOptions& options) {
  command
      .add_option("drawings", options.drawings,
                  "Drawings with --shapes that the joint net has not learned from")
      ->type_name("DIR")
      ->required();
  command.add_option("--shapes", options.shapes, "What script/shape-maps has written")
      ->type_name("DIR")
      ->required();
  command
      .add_option("--first-hand", options.first_hand, "Drawings of the hands before this one are left out")
      ->type_name("NAME");
  command.add_option("-o,--output", options.output, "Weights file to write")
      ->capture_default_str()
      ->check(outputFile("skel-limb-net"));
  bindLearningOptions(command, options);
}

ExitCode runLimbTraining(const LimbTrainingOptions& options) {
  Hands hands = readHands(options.hands, options.first_hand);
  auto files = drawingsWithShapes(findJointedDrawings(options.drawings), options.shapes);
  std::erase_if(files,
                [&](const auto& file) { return hands.learned.contains(drawingName(file.first.image)); });
  if (files.empty()) throw UsageError("there are no drawings with shapes to learn from");
  std::vector<std::string> images;
  for (const auto& [drawing, shapes] : files) images.push_back(drawing.image);
  uniteTwins(images, options.folds, hands);
  ensureWritableFile(options.output);
  std::vector<std::vector<Case>> of_drawing(files.size());
  parallelFor(files.size(), options.threads,
              [&](std::size_t i) { of_drawing[i] = limbsOf(files[i].first, files[i].second); });
  std::vector<Case> cases;
  for (const std::vector<Case>& some : of_drawing) cases.insert(cases.end(), some.begin(), some.end());
  if (cases.empty()) throw UsageError("no limb of these drawings lies against its figure");
  LogisticFitOptions fit;
  fit.hidden = 0;  // units bring nothing with so few limbs
  fit.decay = 5e-3;
  const LogisticNet net = learnFromCases(cases, hands, options, printLimbs, fit);
  writeFile(options.output, formatLimbNet({net, "skel-train limbs --seed " + std::to_string(options.seed) +
                                                    ": " + std::to_string(cases.size()) + " limbs of " +
                                                    std::to_string(files.size()) + " drawings"}));
  std::printf("wrote %s\n", printable(options.output).c_str());
  return ExitCode::kDone;
}

}  // namespace skel
