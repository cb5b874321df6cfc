#include "animator/list_command.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "animator/load_character.h"
#include "animator/rig_text.h"
#include "libskel/animation/clip_library.h"
#include "libskel/animation/joint_roles.h"
#include "libskel/core/text.h"

namespace skel {
namespace {

void printClip(const Clip& clip, const char* note) {
  std::printf("  %-12s %5.2f s  %2d joint%s  %s\n", printable(clip.name).c_str(), double(clip.duration_s()),
              int(clip.tracks.size()), clip.tracks.size() == 1 ? " " : "s", note);
}

void printJoints(const Skeleton& skeleton) {
  std::printf("joints:\n");
  for (const auto& [j, spaces] : asTree(skeleton))
    std::printf("%s%s\n", spaces.c_str(), printable(skeleton.joints[j].name).c_str());
}

}  // namespace

void bindListOptions(CLI::App& app, ListOptions& options) {
  app.add_option("FILE", options.file,
                 "A rigged character (.glb): lists its clips, those that fit it, its joints");
  bindClipSource(app, options.clips);
}

ExitCode runList(const ListOptions& options) {
  const std::vector<Clip> library = toldClipLibrary(options.clips);
  if (options.file.empty()) {
    std::string body_plan;
    for (const Clip& clip : library) {
      if (&clip == &library.front() || clip.template_name != body_plan)
        std::printf("%s:\n", clip.template_name.empty() ? "any" : printable(clip.template_name).c_str());
      body_plan = clip.template_name;
      printClip(clip, "");
    }
    return ExitCode::kDone;
  }
  const CharacterFile file = loadModel(options.file);
  std::printf("clips of %s:\n", printable(options.file).c_str());
  for (const Clip& clip : file.clips) printClip(clip, "");
  std::printf("clips that fit:\n");
  const std::vector<Clip> fitting = clipsFor(library, file.character);
  for (const Clip& clip : fitting) printClip(clip, "");
  if (fitting.empty()) std::printf("  none: %s\n", printable(whyNoRoles(file.character.skeleton)).c_str());
  for (const Clip& clip : library)
    if (const std::string fault = isOwn(clip) ? faultOf(clip, file.character.skeleton) : std::string();
        !fault.empty())
      std::printf("  %-12s %s\n", printable(clip.name).c_str(), printable("does not fit: " + fault).c_str());
  printJoints(file.character.skeleton);
  return ExitCode::kDone;
}

}  // namespace skel
