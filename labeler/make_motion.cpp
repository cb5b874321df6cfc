#include "labeler/make_motion.h"

#include <filesystem>
#include <optional>

#include "labeler/drawing_list.h"
#include "libskel/core/caught_error.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/parallel.h"
#include "libskel/core/progress.h"
#include "libskel/core/standard_output.h"
#include "libskel/image/read_image.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/skeleton/motion_file.h"

namespace skel {
namespace {

namespace fs = std::filesystem;

RigOptions rigOptionsOf(const MotionOptions& options, const SkeletonTemplate& body_plan) {
  RigOptions rig;
  rig.mlp = options.mlp;
  rig.body_plan = body_plan;
  rig.recognizer = options.recognizer;
  rig.last = LastStage::kJoints;
  return rig;
}

RigInput inputOf(const DrawingFiles& files) {
  RigInput input;
  input.image = readImage(files.image);
  input.file = files.image;
  if (const auto mask = givenMask(files)) input.mask = readMaskOf(input.image, *mask);
  return input;
}

// That of most of some frames, as the nets see them.
const SkeletonTemplate& planOfMost(const std::vector<DrawingFiles>& drawings, const MotionOptions& options) {
  constexpr std::size_t kAskedFrames = 7;
  const BodyPlans& plans = options.body_plans;
  if (plans.size() == 1) return plans.front();
  RigOptions rig = rigOptionsOf(options, plans[0]);
  rig.otherwise = {plans[1], {}};
  int others = 0, asked = 0;
  const std::size_t every = std::max<std::size_t>(1, drawings.size() / kAskedFrames);
  for (std::size_t i = 0; i < drawings.size(); i += every) {
    const RiggedDrawing rigged =
        throwingErrors(drawings[i].image, [&] { return rigCharacter(inputOf(drawings[i]), rig); });
    if (!rigged.found()) continue;
    ++asked;
    others += rigged.body_plan.name == plans[1].name;
  }
  return plans[2 * others > asked ? 1 : 0];
}

const SkeletonTemplate& planInFile(const std::string& path, const BodyPlans& plans) {
  const LookAtOutputs look;
  return isFileToReplace(path) ? planNamed(templateOfMotion(path), plans) : plans.front();
}

// Joints stay open, and `reason` says why, where there is no figure.
MotionFrame frameOf(const DrawingFiles& files, const MotionOptions& options,
                    const SkeletonTemplate& body_plan, std::string& reason) {
  RigInput input = inputOf(files);
  MotionFrame frame;
  frame.image_file = pathSeenFrom(options.output, files.image);
  frame.image_width = input.image.width;
  frame.image_height = input.image.height;
  frame.joints.resize(body_plan.joints.size());
  const RiggedDrawing rigged = rigCharacter(std::move(input), rigOptionsOf(options, body_plan));
  reason = rigged.silhouette.reason;
  if (!rigged.found()) return frame;
  for (const Joint& joint : rigged.recognition.skeleton.joints)
    frame.joints[static_cast<size_t>(body_plan.find(joint.name))] =
        PlacedJoint{joint.image, joint.confidence, joint.origin};
  return frame;
}

}  // namespace

MotionCounts makeMotion(const std::string& dir, const MotionOptions& given, const OnError& on_note) {
  MotionOptions options = given;
  if (options.output.empty()) {
    const fs::path folder = fs::absolute(dir).lexically_normal();
    const fs::path name = folder.has_filename() ? folder.filename() : folder.parent_path().filename();
    options.output = "out/" + name.string() + kMotionFileEnding;
  }
  const std::vector<DrawingFiles> drawings = findDrawings(dir);
  noteOutput(options.output);
  for (const DrawingFiles& drawing : drawings) noteInput(drawing.image);
  if (!options.force) requireNoEdits(options.output, planInFile(options.output, options.body_plans));
  const SkeletonTemplate& body_plan = planOfMost(drawings, options);

  MotionFile motion;
  motion.frame_rate = options.frame_rate;
  motion.frames.resize(drawings.size());
  std::vector<std::string> reasons(drawings.size());
  ProgressBar bar("motion", drawings.size());
  parallelFor(drawings.size(), 0, [&](std::size_t i) {
    try {
      motion.frames[i] = frameOf(drawings[i], options, body_plan, reasons[i]);
    } catch (...) {
      throw caughtError(drawings[i].image);
    }
    motion.frames[i].time_s = static_cast<double>(i) / options.frame_rate;
    bar.advance();
  });
  bar.clear();
  MotionCounts counts{options.output, static_cast<int>(drawings.size()), 0};
  for (std::size_t i = 0; i < drawings.size(); ++i) {
    if (reasons[i].empty()) continue;
    ++counts.without_figure;
    on_note(InputError(drawings[i].image, reasons[i]));
  }
  if (counts.without_figure == counts.frames) throw InputError(dir, "shows no figure in any frame");
  writeFile(options.output, formatMotionFile(motion, body_plan));
  return counts;
}

}  // namespace skel
