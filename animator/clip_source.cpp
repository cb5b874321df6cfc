#include "animator/clip_source.h"

#include <CLI/CLI.hpp>
#include <filesystem>

#include "libskel/animation/clip_file.h"
#include "libskel/animation/clip_library.h"
#include "libskel/animation/keyframe_clip.h"
#include "libskel/animation/retarget_motion.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/deform/figure_shape.h"

namespace skel {

void bindClipSource(CLI::App& app, ClipSource& source) {
  app.add_option("--clips-dir", source.clips_dir,
                 "A folder of clip files (.clip.json) beside those that come with skel")
      ->type_name("DIR");
  app.add_option("--interpolation", source.interpolation,
                 "How joints turn between the keys of a key-frame clip: slerp, or linear on its angles")
      ->check(CLI::IsMember({"slerp", "linear"}))
      ->capture_default_str();
  app.add_option("--clip-up", source.clip_up, "The axis of a key-frame clip that points up")
      ->check(CLI::IsMember({"y", "z"}))
      ->capture_default_str();
}

std::vector<Clip> clipLibrary(const ClipSource& source) {
  return source.clips_dir.empty() ? builtinClips() : clipsWithFolder(source.clips_dir);
}

Clip fitted(const Clip& clip, const RiggedCharacter& character) {
  RetargetOptions options;
  options.shape = measureFigure(character.mesh, character.weights, character.skeleton);
  return retargetToRest(clip, character.skeleton, options);
}

Clip loadClipFor(const std::string& path, const RiggedCharacter& character, const ClipSource& source) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending == ".bvh" || ending == ".BVH")
    return retargetMotion(readBvh(path), path, character.skeleton,
                          measureFigure(character.mesh, character.weights, character.skeleton))
        .clip;
  const std::string text = readFile(path);
  if (isKeyframeClip(text)) {
    KeyframeClipOptions options;
    options.z_up = source.clip_up == "z";
    if (source.interpolation == "linear") options.interpolation = RotationInterpolation::kAngles;
    return parseKeyframeClip(text, path, character.skeleton, options);
  }
  const Clip clip = parseClip(text, path);
  for (const JointTrack& track : clip.tracks)
    if (character.skeleton.find(track.joint) < 0)
      throw InputError(path, "moves \"" + track.joint + "\", which this character lacks");
  for (const FootContact& contact : clip.contacts)
    if (character.skeleton.find(contact.joint) < 0)
      throw InputError(path, "puts \"" + contact.joint + "\" on the ground, which this character lacks");
  return fitted(clip, character);
}

}  // namespace skel
