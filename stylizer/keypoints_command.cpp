#include <cstdio>
#include <filesystem>

#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/text.h"
#include "stylizer/commands.h"

namespace skel {
namespace fs = std::filesystem;

ExitCode runKeypoints(const KeypointsCommandOptions& given) {
  KeypointOptions options = given.find;
  if (options.output.empty()) {
    fs::path film = fs::absolute(options.film.path).lexically_normal();
    if (!film.has_filename()) film = film.parent_path();
    options.output = "out/" + film.stem().string() + kMotionFileEnding;
  }
  noteOutput(options.output);
  if (!given.force) requireNoEdits(options.output, loadTemplate("biped"));
  const Keypoints found = findKeypoints(options);
  writeFile(options.output, formatMotionFile(found.motion, loadTemplate("biped")));
  int keys = 0;
  for (const MotionFrame& frame : found.motion.frames) keys += frame.key;
  std::printf("%s: %d frames, %d key frames%s", printable(options.output).c_str(),
              int(found.motion.frames.size()), keys, found.loop ? ", a loop" : "");
  if (found.without_figure > 0) std::printf(", %d without a figure", found.without_figure);
  std::printf("\n  limbs renamed in %d frames (arms) and %d (legs); unevenness %.4f as seen, %.4f smoothed\n",
              found.arms_swapped, found.legs_swapped, found.unevenness_seen, found.unevenness);
  sayOtherPlan(found, options.film.path);
  sayAssumedRate(options.film);
  sayUnusedRate(options.film);
  return ExitCode::kDone;
}

}  // namespace skel
