#include "infer/evaluate.h"
#include "infer/infer_options.h"
#include "libskel/cli/tool.h"

int main(int argc, char** argv) {
  CLI::App app("Turns a drawing of a character into a rigged, textured 3D model (.glb).", "skel-infer");
  app.footer(
      "Example: skel-infer cat.png -o rigged\nWrites rigged/cat.glb, the skeleton as cat.skeleton.json (mend "
      "it and hand it\n"
      "back by --skeleton), and pictures of what was seen.");
  skel::InferOptions infer;
  infer.version = skel::skelVersion();
  infer.nets = skel::netHashes();
  skel::bindInferOptions(app, infer);
  skel::EvaluateOptions evaluate;
  CLI::App* evaluation =
      app.add_subcommand("evaluate", "Measures joints and silhouettes against annotated drawings");
  skel::bindEvaluateOptions(*evaluation, evaluate);
  return skel::runTool(app, argc, argv,
                       [&] { return *evaluation ? skel::runEvaluate(evaluate) : skel::runInfer(infer); });
}
