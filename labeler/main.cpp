#include "labeler/commands.h"
#include "libskel/cli/tool.h"

int main(int argc, char** argv) {
  CLI::App app(
      "Label joint candidates of drawings, place joints, mend masks. With a path alone: in a window (H there "
      "shows "
      "all keys).",
      "skel-label");
  skel::LabelerOptions options;
  std::function<skel::ExitCode()> run;
  skel::bindCommands(app, options, run);
  return skel::runTool(app, argc, argv, [&] { return run(); });
}
