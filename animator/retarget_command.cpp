#include "animator/retarget_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <optional>

#include "animator/glb_output.h"
#include "animator/load_character.h"
#include "animator/rig_source.h"
#include "libskel/animation/clip_file.h"
#include "libskel/animation/clip_library.h"
#include "libskel/animation/pose_hash.h"
#include "libskel/cli/outputs.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/text.h"
#include "libskel/export/formats.h"
#include "libskel/import/read_character.h"

namespace skel {
namespace {

std::string listed(const std::vector<std::string>& names) {
  return names.empty() ? "none" : printable(joined(names));
}

void report(const JointMatch& match) {
  std::printf("matched %s:\n", match.by_shape
                                   ? "by the shape of the tree, which may be wrong, as names tell too little"
                                   : "by name");
  for (const auto& [ours, theirs] : match.joints)
    std::printf("  %-16s %s\n", printable(ours).c_str(), printable(theirs).c_str());
  std::printf("not matched, of the character: %s\n", listed(match.ours_left).c_str());
  std::printf("not matched, of the motion: %s\n", listed(match.theirs_left).c_str());
}

Clip motionFor(const RetargetCommandOptions& options, const CharacterFile& file) {
  if (!options.motion.ends_with(".bvh")) {
    ClipNotes notes;
    Clip clip;
    try {
      clip = clipFor(options.motion, file, options.clips, &notes);
    } catch (const UsageError& error) {
      if (!options.clips.clips_dir.empty()) throw;
      throw UsageError(std::string(error.what()) + "; one of a folder of your own: --clips-dir DIR");
    }
    if (!notes.of_file.empty()) std::printf("%s\n", printable(notes.of_file).c_str());
    for (const auto& clauses : {notes.of_character, notes.of_arms})
      for (const std::string& clause : clauses)
        std::printf("%s: note: %s\n", printable(options.target).c_str(), printable(clause).c_str());
    return clip;
  }
  RetargetedMotion result = loadBvhFor(options.motion, file.character, options.clips);
  report(result.match);
  return std::move(result.clip);
}

// Of a clip file that eases, what stands in it.
std::optional<ClipKeys> easedInFile(const RetargetCommandOptions& options) {
  const bool is_path = options.motion.ends_with(".json");
  std::vector<std::string> paths;
  if (is_path)
    paths = {options.motion};
  else if (!options.clips.clips_dir.empty())
    paths = filesBelow(options.clips.clips_dir);
  for (const std::string& path : paths) {
    if (!is_path && !path.ends_with(kClipFileEnding)) continue;
    try {
      std::optional<ClipKeys> keys = easedKeysIn(path);
      if (keys && (is_path || keys->clip.name == options.motion)) return keys;
    } catch (const InputError&) {  // left out
    }
  }
  return std::nullopt;
}

// The keys to write for `clip`, as they are edited: eased as in the file if it is for this very rest pose.
ClipKeys keysOf(const Clip& clip, const RetargetCommandOptions& options, const CharacterFile& file) {
  std::optional<ClipKeys> keys = easedInFile(options);
  if (!keys || hasClip(file.clips, options.motion)) return {clip};
  if (keys->clip.rest_pose == restPoseHash(file.character.skeleton)) {
    keys->clip.rest_pose.clear();
    if (withEvenKeys(*keys) == clip) return *keys;
  }
  std::printf("%s: note: its ease is written as even keys, as it is not for the rest pose of %s\n",
              printable(options.motion).c_str(), printable(options.target).c_str());
  return {clip};
}

// What the output's name asks for.
std::string encoded(const std::string& path, CharacterFile file, const ClipKeys& keys) {
  const Clip& clip = keys.clip;
  if (path.ends_with(kClipFileEnding)) return formatClipKeys(madeFor(file.character.skeleton, keys));
  if (path.ends_with(".bvh")) {
    const std::vector<Clip> clips = {clip};
    return exportBvh({file.character, clips, {stemOf(path)}})[0].bytes;
  }
  std::erase_if(file.clips, [&](const Clip& other) { return other.name == clip.name; });
  file.clips.push_back(clip);
  return encodeGlb(
      file.character, file.clips,
      {.name = file.name, .bones = file.bones, .generator = kWrittenByRetarget, .ink_hull = file.ink_hull});
}

}  // namespace

void bindRetargetOptions(CLI::App& app, RetargetCommandOptions& options) {
  app.add_option(
         "MOTION", options.motions,
         "The motion: a .bvh of anybody's skeleton, a clip that comes with skel or lies in --clips-dir, by "
         "its name, or a clip file")
      ->required()
      ->type_name("TEXT");
  app.add_option("--to", options.target, "The rigged character (.glb) that is to move so, one a run")
      ->required()
      ->type_name("FILE");
  app.add_option("-o,--output", options.output,
                 "What to write: the character with the motion among its clips (.glb), or the motion alone "
                 "(.clip.json, .bvh); without: out/<motion>.glb")
      ->type_name("FILE")
      ->check(outputFile("skel-clip"));
  app.add_option("--name", options.name, "Of the clip; without: that of the motion");
  bindClipSource(app, options.clips);
}

ExitCode runRetarget(const RetargetCommandOptions& asked) {
  if (asked.motions.size() > 1)
    throw UsageError(asked.motions.back() +
                     ": is one too many: a run takes one motion, and one character by --to");
  RetargetCommandOptions options = asked;
  options.motion = options.motions.front();
  const std::string path =
      options.output.empty() ? glbNamedAfter(options.motion, kWrittenByRetarget) : options.output;
  if (!path.ends_with(".glb") && !path.ends_with(".bvh") && !path.ends_with(kClipFileEnding))
    throw UsageError(path + ": must end in .glb, .clip.json or .bvh");
  noteOutput(path);
  options.clips.names = {options.motion};
  toldClipLibrary(options.clips);
  CharacterFile file = loadModel(options.target);
  const Clip clip = motionFor(options, file);
  ClipKeys keys = path.ends_with(kClipFileEnding) ? keysOf(clip, options, file) : ClipKeys{clip};
  if (!options.name.empty()) keys.clip.name = printable(options.name);
  writeFile(path, encoded(path, std::move(file), keys));
  std::printf("wrote %s\n", printable(path).c_str());
  return ExitCode::kDone;
}

}  // namespace skel
