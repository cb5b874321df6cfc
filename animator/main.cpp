#include "animator/bind_command.h"
#include "animator/info_command.h"
#include "animator/list_command.h"
#include "animator/render_command.h"
#include "animator/retarget_command.h"
#include "animator/view_command.h"
#include "libskel/cli/tool.h"

namespace {

// Adds a subcommand; when it is given, `chosen` becomes what it does.
template <class Options>
void add(CLI::App& app, std::function<skel::ExitCode()>& chosen, const std::string& name,
         const std::string& help, void (*bind)(CLI::App&, Options&), skel::ExitCode (*run)(const Options&)) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(name, help);
  bind(*command, *options);
  command->callback([=, &chosen] { chosen = [=] { return run(*options); }; });
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Brings rigged characters to life: bind, pose, play, export.", "skel-animate");
  app.footer("Example: skel-animate bind elk.obj --skeleton elk.rig.json -o elk.glb");
  app.require_subcommand(1);
  std::function<skel::ExitCode()> chosen;
  add(app, chosen, "info", "Says what a model holds", skel::bindInfoOptions, skel::runInfo);
  add(app, chosen, "list", "Lists clips, and the joints of a character", skel::bindListOptions,
      skel::runList);
  add(app, chosen, "bind", "Binds a model to a skeleton", skel::bindBindOptions, skel::runBind);
  add(app, chosen, "weights", "Computes which joints carry a vertex, and saves that",
      skel::bindWeightsOptions, skel::runWeights);
  add(app, chosen, "retarget", "Makes a character move as a motion file says", skel::bindRetargetOptions,
      skel::runRetarget);
  add(app, chosen, "render", "Makes a film of a character, or of a drawing, that moves by a clip",
      skel::bindRenderOptions, skel::runRender);
  add(app, chosen, "view", "Shows a character in a window: play, pose, set keys, write films",
      skel::bindViewOptions, skel::runView);
  return skel::runTool(app, argc, argv, [&] { return chosen(); });
}
