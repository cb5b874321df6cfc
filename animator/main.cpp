#include "animator/bind_command.h"
#include "animator/info_command.h"
#include "animator/list_command.h"
#include "animator/render_command.h"
#include "animator/retarget_command.h"
#include "animator/view_command.h"
#include "libskel/cli/tool.h"

int main(int argc, char** argv) {
  CLI::App app("Brings rigged characters to life: bind, pose, play, export.", "skel-animate");
  app.footer("Example: skel-animate bind elk.obj --skeleton elk.rig.json -o elk.glb");
  app.require_subcommand(1);
  std::function<skel::ExitCode()> chosen;
  skel::addCommand(app, chosen, "info", "Says what a model holds", skel::bindInfoOptions, skel::runInfo);
  skel::addCommand(app, chosen, "list", "Lists clips, and the joints of a character", skel::bindListOptions,
                   skel::runList);
  skel::addCommand(app, chosen, "bind", "Binds a model to a skeleton", skel::bindBindOptions, skel::runBind);
  skel::addCommand(app, chosen, "weights", "Computes which joints carry a vertex, and saves that",
                   skel::bindWeightsOptions, skel::runWeights);
  skel::addCommand(app, chosen, "retarget", "Makes a character move as a motion file says",
                   skel::bindRetargetOptions, skel::runRetarget);
  skel::addCommand(app, chosen, "render",
                   "Makes a film of a character, or of a drawing, that moves by a clip",
                   skel::bindRenderOptions, skel::runRender);
  skel::addCommand(app, chosen, "view", "Shows a character in a window: play, pose, set keys, write films",
                   skel::bindViewOptions, skel::runView);
  return skel::runTool(app, argc, argv, [&] { return chosen(); });
}
