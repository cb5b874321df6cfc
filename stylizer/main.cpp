#include "libskel/cli/tool.h"
#include "stylizer/commands.h"

int main(int argc, char** argv) {
  CLI::App app("Learns how a cartoon moves, and makes another character move so.", "skel-style");
  app.footer("Example: skel-style make --character me.png --content walk.mp4 --style zombie.mp4 -o out.mp4");
  app.require_subcommand(1);
  std::function<skel::ExitCode()> chosen;
  skel::addCommand(app, chosen, "make", "From a drawing and two films to a new film, in one step",
                   skel::bindMake, skel::runMake);
  skel::addCommand(app, chosen, "keyframes", "Which frames of a film tell most of its motion",
                   skel::bindKeyframes, skel::runKeyframes);
  skel::addCommand(app, chosen, "keypoints", "Finds the joints of the figure in every frame of a film",
                   skel::bindKeypoints, skel::runKeypoints);
  skel::addCommand(app, chosen, "database", "A folder of motions with action classes: add, list, check",
                   skel::bindDatabase, skel::runDatabase);
  skel::addCommand(app, chosen, "fit", "Splits motions into a style basis and components", skel::bindFit,
                   skel::runFit);
  skel::addCommand(app, chosen, "transfer", "One motion in the style of another", skel::bindTransfer,
                   skel::runTransfer);
  skel::addCommand(app, chosen, "render", "Makes a drawing perform a motion: a film, or a clip",
                   skel::bindRender, skel::runRender);
  skel::addCommand(app, chosen, "inspect", "Draws what is in a motion: key frames, distances, components",
                   skel::bindInspect, skel::runInspect);
  return skel::runTool(app, argc, argv, [&] { return chosen(); });
}
