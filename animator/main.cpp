#include "animator/bind_command.h"
#include "animator/info_command.h"
#include "animator/list_command.h"
#include "animator/render_command.h"
#include "animator/retarget_command.h"
#include "animator/view_command.h"
#include "libskel/cli/tool.h"

int main(int argc, char** argv) {
  CLI::App app("Brings rigged characters to life: bind, pose, play, export.", "skel-animate");
  app.footer("Example: skel-animate render drawing.png --clips all -o films/");
  app.require_subcommand(1);
  std::function<skel::ExitCode()> chosen;
  skel::addCommand(app, chosen, "info", "Says what a model holds", skel::bindInfoOptions, skel::runInfo,
                   "skel-animate info hero.glb");
  skel::addCommand(app, chosen, "list", "Lists clips, and the joints of a character", skel::bindListOptions,
                   skel::runList, "skel-animate list hero.glb");
  skel::addCommand(app, chosen, "bind", "Binds a model to a skeleton", skel::bindBindOptions, skel::runBind,
                   "skel-animate bind elk.obj --skeleton elk.rig.json -o elk.glb");
  skel::addCommand(app, chosen, "weights", "Computes which joints carry a vertex, and saves that",
                   skel::bindWeightsOptions, skel::runWeights,
                   "skel-animate weights elk.obj --skeleton elk.rig.json -o elk.weights.json");
  skel::addCommand(app, chosen, "retarget", "Makes a character move as a motion file says",
                   skel::bindRetargetOptions, skel::runRetarget,
                   "skel-animate retarget dance.bvh --to hero.glb -o hero-dances.glb");
  skel::addCommand(
      app, chosen, "render", "Makes a film of a character, or of a drawing, that moves by a clip",
      skel::bindRenderOptions, skel::runRender, "skel-animate render hero.png --clip dance -o dance.mp4");
  skel::addCommand(app, chosen, "view", "Shows a character in a window: play, pose, set keys, write films",
                   skel::bindViewOptions, skel::runView, "skel-animate view hero.glb");
  return skel::runTool(app, argc, argv, [&] { return chosen(); });
}
