#include <cstdio>
#include <filesystem>
#include <sstream>

#include "libskel/animation/clip_file.h"
#include "libskel/core/files.h"
#include "libskel/core/progress.h"
#include "libskel/core/text.h"
#include "libskel/style/motion_clip.h"
#include "libskel/style/wear_motion.h"
#include "stylizer/commands.h"

namespace skel {
namespace {

constexpr double kMaxFilm_s = 3600;
constexpr double kTorn = .02;  // of the drawing, which shows

std::vector<double> timesOf(const MotionFile& motion) {
  std::vector<double> times_s;
  for (const MotionFrame& frame : motion.frames) times_s.push_back(frame.time_s);
  return times_s;
}

}  // namespace

Stage setStage(const std::string& character, const PerformRequest& request, const std::string& output) {
  openVideo(output, {.transparent = request.background == "none"});
  std::vector<std::string> order;
  std::istringstream parts(request.order);
  for (std::string part; std::getline(parts, part, ',');) order.push_back(part);
  FilmBackground background = readBackground(request.background);
  Performer performer = readPerformer(character, request.mended);
  if (background.keep && character.ends_with(".glb")) {
    performer.notes.push_back("a model has no background to keep");
    background = {false, keepsTransparency(output) ? kClear : kWhite, {}};
  } else if (background.keep) {
    background = keptBackground(performer.image, output);
  }
  Puppet puppet = makePuppet(performer, order);
  for (const std::string& note : performer.notes)
    std::fprintf(stderr, "%s: note: %s\n", printable(character).c_str(), printable(note).c_str());
  return {std::move(performer), std::move(puppet), std::move(background)};
}

void perform(const Stage& stage, const MotionFile& motion, const std::string& path, bool loops,
             const PerformRequest& request, const std::string& output) {
  const SkeletonTemplate plan = loadTemplate("biped");
  const Puppet& puppet = stage.puppet;
  const std::vector<double> times_s = timesOf(motion);
  VideoOptions video_options;
  video_options.frame_rate = request.frame_rate > 0 ? request.frame_rate : motion.frame_rate;
  video_options.transparent = stage.background.isTransparent();
  openVideo(output, video_options);  // says what rate cannot be written
  const double duration_s =
      request.duration_s > 0 ? request.duration_s : motionLength_s(times_s, video_options.frame_rate);
  if (duration_s > kMaxFilm_s)
    throw InputError(path,
                     "lasts more than an hour, the longest film; say by --duration how much is to be shown");
  const PoseMatrix worn =
      wornBy(puppet.rest, posesOf(motion, plan, path), plan, {.travels = !request.in_place});
  const PuppetFilmOptions film{.background = stage.background,
                               .size_px = request.size_px,
                               .frame_rate = video_options.frame_rate,
                               .duration_s = duration_s,
                               .loops = loops};
  const PuppetFrames frames = layOut(puppet, stage.performer, worn, times_s, film);
  const int count = int(frames.poses.cols());
  video_options.width = frames.width;
  video_options.height = frames.height;
  video_options.frames = count;
  const auto video = openVideo(output, video_options);
  {
    ProgressBar bar("frames", std::size_t(count));
    writePuppetFilm(puppet, frames, *video, [&] { bar.advance(); });
    video->finish();
  }
  std::printf("%s: %d frames of %dx%d, %.2f s; at most %.1f %% of the drawing torn\n",
              printable(output).c_str(), count, frames.width, frames.height, count / frames.frame_rate,
              100 * frames.torn);
  if (frames.torn > kTorn)
    std::fprintf(stderr,
                 "%s: note: the motion tears the drawing: look at it, and at the joints (skel-label)\n",
                 printable(output).c_str());
}

ExitCode runRender(const RenderOptions2D& options) {
  if (options.output.empty() && options.to_clip.empty())
    throw UsageError("render: name a film by -o, a clip by --to-clip, or both");
  if (!options.output.empty() && options.character.empty())
    throw UsageError("render: a film needs --character DRAWING");
  const SkeletonTemplate plan = loadTemplate("biped");
  const MotionFile motion = readMotion(options.motion);
  const PoseMatrix poses = posesOf(motion, plan, options.motion);
  const bool loops = options.loop == "auto" ? isLoop(poses) : options.loop == "yes";
  // What is refused is refused before the film is made.
  std::string clip_text;
  double clip_s = 0;
  if (!options.to_clip.empty()) {
    const std::string file = std::filesystem::path(options.to_clip).filename().string();
    const Clip clip = clipOfMotion(poses, timesOf(motion), loops, plan, file.substr(0, file.find('.')));
    clip_text = formatClip(clip);
    clip_s = double(clip.duration_s());
  }
  if (!options.output.empty())
    perform(setStage(options.character, options.perform, options.output), motion, options.motion, loops,
            options.perform, options.output);
  if (!options.to_clip.empty()) {
    writeFile(options.to_clip, clip_text);
    std::printf("%s: %.2f s\n", printable(options.to_clip).c_str(), clip_s);
  }
  return ExitCode::kDone;
}

}  // namespace skel
