#include <cstdio>
#include <filesystem>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/text.h"
#include "stylizer/commands.h"
#include "stylizer/film_trace.h"

namespace skel {
namespace {
namespace fs = std::filesystem;

// The motion of a film: the file given, the one in the work folder if it is of this film, or a new one there.
NamedMotion motionOf(const std::string& path, const std::string& name, const MakeOptions& options) {
  const SkeletonTemplate plan = loadTemplate("biped");
  if (path.ends_with(kMotionFileEnding)) return {path, readMotionFile(path, plan)};
  const std::string file = (fs::path(options.work) / (name + kMotionFileEnding)).string();
  KeypointOptions find;
  find.film = options.film;
  find.film.path = path;
  find.output = file;
  find.loop = options.request.loop;
  const std::string film_hash = filmHash(find.film);
  const bool goes_on = !options.force && fs::exists(file);
  if (goes_on) {
    const MotionIsOf is_of = filmOfMotion(file, film_hash, filmName(path));
    if (is_of == MotionIsOf::kAnotherFilmMended)
      throw InputError(file, "was mended by hand, and was made of another film than " + printable(path) +
                                 " or by other options; name another folder by --work, or give --force to "
                                 "lose what was mended");
    if (is_of == MotionIsOf::kThisFilm) {
      std::printf("%s: taken as it is\n", printable(file).c_str());
      return {file, readMotionFile(file, plan)};
    }
  }
  noteOutput(file);
  ensureWritableFolderOf(file);
  const Keypoints found = findKeypoints(find);
  forgetTrace(file);
  writeFile(file, formatMotionFile(found.motion, plan));
  leaveTrace(file, film_hash);
  std::printf("%s: %d frames%s\n", printable(file).c_str(), int(found.motion.frames.size()),
              goes_on ? ", made anew: what was there was of another film, or by other options" : "");
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
  const Stage stage = setStage(options.character, options.perform, options.output);
  const NamedMotion content = motionOf(options.content, "content", options);
  const NamedMotion style = motionOf(options.style, "style", options);
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
