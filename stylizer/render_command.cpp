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

Stage setStage(const std::string& character, const PerformRequest& request, const std::string& output) {
  openVideo(output, {.transparent = request.background == "none"});
  PuppetOptions options;
  if (!request.order.empty()) {
    options.order.clear();
    std::istringstream parts(request.order);
    for (std::string part; std::getline(parts, part, ',');) options.order.push_back(part);
  }
  FilmBackground background = readBackground(request.background);
  Performer performer = readPerformer(character);
  Puppet puppet = makePuppet(performer, loadTemplate("biped"), options);
  return {std::move(performer), std::move(puppet), std::move(background)};
}

void perform(const Stage& stage, const MotionFile& motion, const std::string& path, bool loops,
             const PerformRequest& request, const std::string& output) {
  const SkeletonTemplate plan = loadTemplate("biped");
  const Puppet& puppet = stage.puppet;
  const PoseMatrix worn =
      wornBy(puppet.rest, posesOf(motion, plan, path), plan, {.travels = !request.in_place});
  const PuppetFilmOptions film{.background = stage.background,
                               .size_px = request.size_px,
                               .frame_rate = request.frame_rate > 0 ? request.frame_rate : motion.frame_rate,
                               .duration_s = request.duration_s,
                               .loops = loops};
  const PuppetFrames frames = layOut(puppet, stage.performer, worn, timesOf(motion), film);
  VideoOptions video_options{.width = frames.width, .height = frames.height, .frame_rate = frames.frame_rate};
  video_options.frames = int(frames.vertices.size());
  video_options.transparent = request.background == "none";
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
    perform(setStage(options.character, options.perform, options.output), motion, options.motion, loops,
            options.perform, options.output);
  }
  if (!options.to_clip.empty()) {
    const std::string file = std::filesystem::path(options.to_clip).filename().string();
    const std::string name = file.substr(0, file.find('.'));
    const Clip clip = clipOfMotion(poses, timesOf(motion), loops, plan, name);
    writeFile(options.to_clip, formatClip(clip));
    std::printf("%s: %.2f s\n", options.to_clip.c_str(), double(clip.duration_s()));
  }
  return ExitCode::kDone;
}

}  // namespace skel
