#include "libskel/cli/tool.h"
#include "trainer/average_nets.h"
#include "trainer/bone_lengths.h"
#include "trainer/confidence_training.h"
#include "trainer/facing_training.h"
#include "trainer/joint_net_figures.h"
#include "trainer/joint_net_training.h"
#include "trainer/limb_training.h"
#include "trainer/loop_training.h"
#include "trainer/page_net_training.h"
#include "trainer/part_net_training.h"
#include "trainer/silhouette_training.h"
#include "trainer/train_command.h"

int main(int argc, char** argv) {
  CLI::App app("Trains the net that tells head, body, hand and leg candidates apart.", "skel-train");
  app.footer(
      "Example: skel-train datasets/characters -o weights.json\n"
      "         skel-infer drawing.png --weights weights.json");
  skel::TrainOptions train;
  skel::bindTrainOptions(app, train);
  skel::EvaluateWeightsOptions evaluate;
  CLI::App* evaluation = app.add_subcommand("evaluate", "Measures weights on labelled characters");
  skel::bindEvaluateWeightsOptions(*evaluation, evaluate);
  skel::FigureSheetOptions sheet;
  CLI::App* figures = app.add_subcommand("figures", "Draws a sheet of generated figures");
  skel::bindFigureSheetOptions(*figures, sheet);
  skel::JointTrainingOptions joint_training;
  CLI::App* joints =
      app.add_subcommand("joints", "Trains the net that finds joints, on generated figures and on drawings");
  skel::bindJointTrainingOptions(*joints, joint_training);
  skel::PageTrainingOptions page_training;
  CLI::App* pages = app.add_subcommand("pages", "Trains the net that tells the figure from its page");
  skel::bindPageTrainingOptions(*pages, page_training);
  skel::PartTrainingOptions part_training;
  CLI::App* parts = app.add_subcommand("parts", "Trains the net that tells a figure's parts");
  skel::bindPartTrainingOptions(*parts, part_training);
  skel::AverageNetsOptions average;
  CLI::App* averaging = app.add_subcommand(
      "average", "Averages nets of joints, of parts or of pages that were trained on from one another");
  skel::bindAverageNetsOptions(*averaging, average);
  skel::BoneLengthsOptions bone_lengths;
  CLI::App* bones = app.add_subcommand("bones", "Tells a joint net how long the bones of drawn figures are");
  skel::bindBoneLengthsOptions(*bones, bone_lengths);
  skel::ConfidenceTrainingOptions confidence_training;
  CLI::App* confidence =
      app.add_subcommand("confidence", "Learns how sure the recognition may be of what it finds");
  skel::bindConfidenceTrainingOptions(*confidence, confidence_training);
  skel::PageCaseOptions silhouette_training;
  silhouette_training.output = "out/silhouette_confidence.json";
  CLI::App* silhouettes = app.add_subcommand(
      "silhouettes", "Learns how sure one may be of a silhouette that was found on a page");
  skel::bindPageCaseOptions(*silhouettes, silhouette_training, "skel-silhouette-confidence");
  skel::PageCaseOptions loop_training;
  loop_training.output = "out/loop_net.json";
  CLI::App* loops =
      app.add_subcommand("loops", "Learns which of what a figure's lines enclose is the ground behind it");
  skel::bindPageCaseOptions(*loops, loop_training, "skel-loop-net");
  skel::LimbTrainingOptions limb_training;
  CLI::App* limbs = app.add_subcommand("limbs", "Learns whether what was found of a limb is one");
  skel::bindLimbTrainingOptions(*limbs, limb_training);
  skel::FacingTrainingOptions facing_training;
  CLI::App* facing = app.add_subcommand("facing", "Learns which way the figures of drawings look");
  skel::bindFacingTrainingOptions(*facing, facing_training);
  return skel::runTool(app, argc, argv, [&] {
    if (*evaluation) return skel::runEvaluateWeights(evaluate);
    if (*figures) return skel::runFigureSheet(sheet);
    if (*joints) return skel::runJointTraining(joint_training);
    if (*bones) return skel::runBoneLengths(bone_lengths);
    if (*confidence) return skel::runConfidenceTraining(confidence_training);
    if (*silhouettes) return skel::runSilhouetteTraining(silhouette_training);
    if (*facing) return skel::runFacingTraining(facing_training);
    if (*limbs) return skel::runLimbTraining(limb_training);
    if (*loops) return skel::runLoopTraining(loop_training);
    if (*averaging) return skel::runAverageNets(average);
    if (*pages) return skel::runPageTraining(page_training);
    if (*parts) return skel::runPartTraining(part_training);
    return skel::runTrain(train);
  });
}
