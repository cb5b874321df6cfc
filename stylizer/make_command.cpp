#include <cstdio>
#include <filesystem>
#include <optional>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/text.h"
#include "stylizer/commands.h"
#include "stylizer/film_trace.h"
#include "stylizer/find_keypoints.h"

namespace skel {
namespace {
namespace fs = std::filesystem;

// --content or --style, looked at before any work.
struct MotionSource {
  KeypointOptions find;               // of a film: its key points, into the work folder
  std::string film_hash;              // empty: a motion file was given
  bool made_anew = false;             // what the work folder holds is of another film
  std::optional<NamedMotion> motion;  // the file given, or the one in the work folder if it is of this film
};

MotionSource lookAt(const std::string& path, const std::string& name, const MakeOptions& options) {
  const SkeletonTemplate plan = loadTemplate("biped");
  if (path.ends_with(kMotionFileEnding))
    return {{}, "", false, NamedMotion{path, readMotionFile(path, plan)}};
  const std::string file = (fs::path(options.work) / (name + kMotionFileEnding)).string();
  MotionSource source;
  source.find.film = options.film;
  source.find.film.path = path;
  source.find.output = file;
  source.find.loop = options.request.loop;
  source.film_hash = filmHash(source.find.film);
  source.made_anew = !options.force && fs::exists(file);
  if (!source.made_anew) return source;
  const MotionIsOf is_of = filmOfMotion(file, source.film_hash, filmName(path));
  if (is_of == MotionIsOf::kAnotherFilmMended)
    throw InputError(file, "was mended by hand, and was made of another film than " + printable(path) +
                               " or by other options; name another folder by --work, or give --force to "
                               "lose what was mended");
  if (is_of == MotionIsOf::kThisFilm) source.motion = {file, readMotionFile(file, plan)};
  return source;
}

NamedMotion motionOf(const MotionSource& source) {
  const std::string& file = source.find.output;
  if (source.motion) {
    if (source.film_hash.empty()) return *source.motion;
    std::printf("%s: taken as it is\n", printable(file).c_str());
    sayUnusedRate(source.find.film);
    return *source.motion;
  }
  const SkeletonTemplate plan = loadTemplate("biped");
  noteOutput(file);
  ensureWritableFolderOf(file);
  const Keypoints found = findKeypoints(source.find);
  forgetTrace(file);
  writeFile(file, formatMotionFile(found.motion, plan));
  leaveTrace(file, source.film_hash);
  std::printf("%s: %d frames%s\n", printable(file).c_str(), int(found.motion.frames.size()),
              source.made_anew ? ", made anew: what was there was of another film, or by other options" : "");
  sayOtherPlan(found, source.find.film.path);
  sayAssumedRate(source.find.film);
  sayUnusedRate(source.find.film);
  // As the next run will see it.
  return {file, readMotionFile(file, plan)};
}

}  // namespace

ExitCode runMake(const MakeOptions& given) {
  MakeOptions options = given;
  if (options.work.empty()) {
    std::string stem = options.output;
    while (stem.ends_with('/')) stem.pop_back();
    options.work = stem + ".work";
  }
  const std::string file = (fs::path(options.work) / (std::string("transfer") + kMotionFileEnding)).string();
  noteOutput(file);
  const SkeletonTemplate plan = loadTemplate("biped");
  const MotionSource content_source = lookAt(options.content, "content", options);
  const MotionSource style_source = lookAt(options.style, "style", options);
  options.perform.mended.force = options.force;
  const Stage stage = setStage(options.character, options.perform, options.output);
  const NamedMotion content = motionOf(content_source);
  const NamedMotion style = motionOf(style_source);
  const MotionTransferReport report = transferMotion({content}, {style}, transferOptions(options.request));
  writeFile(file, formatMotionFile(report.motion, plan));
  std::printf("%s: mean pose %.0f %% of the way, phase correlation %.3f%s\n", printable(file).c_str(),
              100 * report.mean_pose_moved, report.phase_correlation,
              report.mirrored ? ", style mirrored" : "");
  sayTransferNotes(report, file);
  perform(stage, readMotionFile(file, plan), file, report.content_loops, options.perform, options.output);
  return ExitCode::kDone;
}

}  // namespace skel
