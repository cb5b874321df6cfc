// Trains the joint net, and shows what it is trained on.
#include "libskel/cli/tool.h"
#include "trainer/joint_net_figures.h"
#include "trainer/joint_net_training.h"

int main(int argc, char** argv) {
  CLI::App app("Trains the net that finds joints, on generated figures.", "skel-train-joints");
  app.require_subcommand(1);
  skel::FigureSheetOptions sheet;
  CLI::App* figures = app.add_subcommand("figures", "Draws a sheet of generated figures");
  skel::bindFigureSheetOptions(*figures, sheet);
  skel::JointTrainingOptions training;
  CLI::App* joints = app.add_subcommand("joints", "Trains the net");
  skel::bindJointTrainingOptions(*joints, training);
  return skel::runTool(app, argc, argv, [&] {
    return figures->parsed() ? skel::runFigureSheet(sheet) : skel::runJointTraining(training);
  });
}
