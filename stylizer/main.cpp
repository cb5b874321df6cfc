#include "libskel/cli/tool.h"
#include "stylizer/commands.h"

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
  CLI::App app("Learns how a cartoon moves, and makes another character move so.", "skel-style");
  app.footer("Example: skel-style make --character me.png --content walk.mp4 --style zombie.mp4 -o out.mp4");
  app.require_subcommand(1);
  std::function<skel::ExitCode()> chosen;
  add(app, chosen, "make", "From a drawing and two films to a new film, in one step", skel::bindMake,
      skel::runMake);
  add(app, chosen, "keyframes", "Which frames of a film tell most of its motion", skel::bindKeyframes,
      skel::runKeyframes);
  add(app, chosen, "keypoints", "Finds the joints of the figure in every frame of a film",
      skel::bindKeypoints, skel::runKeypoints);
  add(app, chosen, "database", "A folder of motions with action classes: add, list, check",
      skel::bindDatabase, skel::runDatabase);
  add(app, chosen, "fit", "Splits motions into a style basis and components", skel::bindFit, skel::runFit);
  add(app, chosen, "transfer", "One motion in the style of another", skel::bindTransfer, skel::runTransfer);
  add(app, chosen, "render", "Makes a drawing perform a motion: a film, or a clip", skel::bindRender,
      skel::runRender);
  add(app, chosen, "inspect", "Draws what is in a motion: key frames, distances, components",
      skel::bindInspect, skel::runInspect);
  return skel::runTool(app, argc, argv, [&] { return chosen(); });
}
