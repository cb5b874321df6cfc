#include "libskel/cli/tool.h"
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
  return skel::runTool(app, argc, argv, [&] {
    return *evaluation ? skel::runEvaluateWeights(evaluate) : skel::runTrain(train);
  });
}
