#include <cstdio>
#include <filesystem>
#include <sstream>

#include "libskel/animation/clip_file.h"
#include "libskel/core/files.h"
#include "libskel/core/progress.h"
#include "libskel/style/motion_clip.h"
#include "libskel/style/wear_motion.h"
#include "stylizer/commands.h"

namespace skel {
namespace {

std::vector<double> timesOf(const MotionFile& motion) {
  std::vector<double> times_s;
  for (const MotionFrame& frame : motion.frames) times_s.push_back(frame.time_s);
  return times_s;
}

}  // namespace

void perform(const RiggedDrawing& drawing, const MotionFile& motion, const std::string& path, bool loops,
             const PerformRequest& request, const std::string& output) {
  const SkeletonTemplate plan = loadTemplate("biped");
  PuppetOptions puppet_options;
  if (!request.order.empty()) {
    puppet_options.order.clear();
    std::istringstream parts(request.order);
    for (std::string part; std::getline(parts, part, ',');) puppet_options.order.push_back(part);
  }
  const Puppet puppet =
      makePuppet(drawing.image, drawing.silhouette, drawing.recognition.skeleton, plan, puppet_options);
  const PoseMatrix worn =
      wornBy(puppet.rest, posesOf(motion, plan, path), plan, {.travels = !request.in_place});
  PuppetFilmOptions film = request.film;
  if (film.frame_rate <= 0) film.frame_rate = motion.frame_rate;
  film.loops = loops;
  const PuppetFrames frames = layOut(puppet, drawing, worn, timesOf(motion), film);
  VideoOptions video_options{.width = frames.width, .height = frames.height, .frame_rate = frames.frame_rate};
  video_options.frames = int(frames.vertices.size());
  video_options.transparent = film.background == "none";
  const auto video = openVideo(output, video_options);
  {
    ProgressBar bar("frames", frames.vertices.size());
    writePuppetFilm(puppet, frames, *video, [&] { bar.advance(); });
    video->finish();
  }
  std::printf("%s: %d frames of %dx%d, %.2f s; %d of %d triangles turned over\n", output.c_str(),
              int(frames.vertices.size()), frames.width, frames.height,
              double(frames.vertices.size()) / frames.frame_rate, frames.flipped,
              int(frames.vertices.size()) * int(puppet.triangles.rows()));
}

ExitCode runRender(const RenderOptions2D& options) {
  if (options.output.empty() && options.to_clip.empty())
    throw UsageError("render: name a film by -o, a clip by --to-clip, or both");
  if (!options.output.empty() && options.character.empty())
    throw UsageError("render: a film needs --character DRAWING");
  const SkeletonTemplate plan = loadTemplate("biped");
  const MotionFile motion = readMotionFile(options.motion, plan);
  const PoseMatrix poses = posesOf(motion, plan, options.motion);
  const bool loops = options.loop == "auto" ? isLoop(poses) : options.loop == "yes";
  if (!options.output.empty()) {
    // What cannot be written is said before anything is rigged.
    openVideo(options.output, {.transparent = options.perform.film.background == "none"});
    perform(rigPerformer(options.character), motion, options.motion, loops, options.perform, options.output);
  }
  if (!options.to_clip.empty()) {
    std::string name = std::filesystem::path(options.to_clip).filename().string();
    name.resize(name.find('.'));
    const Clip clip = clipOfMotion(poses, timesOf(motion), loops, plan, name);
    writeFile(options.to_clip, formatClip(clip));
    std::printf("%s: %.2f s\n", options.to_clip.c_str(), double(clip.duration_s()));
  }
  return ExitCode::kDone;
}

}  // namespace skel
