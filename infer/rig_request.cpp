#include "infer/rig_request.h"

#include <algorithm>
#include <cstdio>

#include "libskel/animation/clip_library.h"
#include "libskel/classifier/weights_file.h"
#include "libskel/core/files.h"
#include "libskel/pipeline/rig_drawing.h"

namespace skel {
namespace {

// Of the library, those that were asked for and fit the body plan, in the order of asking; all if none was.
std::vector<Clip> askedClips(const std::vector<Clip>& library, const SkeletonTemplate& body_plan,
                             const std::vector<std::string>& names) {
  const std::vector<Clip> fitting = clipsFor(library, body_plan);
  if (names.empty()) return fitting;
  std::vector<Clip> asked;
  const auto among = [](const std::vector<Clip>& clips, const std::string& name) {
    return std::find_if(clips.begin(), clips.end(), [&](const Clip& clip) { return clip.name == name; });
  };
  for (const std::string& name : names)
    if (const auto clip = among(fitting, name); clip != fitting.end() && among(asked, name) == asked.end())
      asked.push_back(*clip);
  return asked;
}

// Throws UsageError if the clip fits no body plan that is asked for.
void requireClip(const std::vector<Clip>& library, const RigOptions& rig, const std::string& name) {
  std::vector<Clip> fitting = clipsFor(library, rig.body_plan);
  if (rig.otherwise)
    for (const Clip& clip : clipsFor(library, rig.otherwise->body_plan))
      if (std::none_of(fitting.begin(), fitting.end(),
                       [&](const Clip& known) { return known.name == clip.name; }))
        fitting.push_back(clip);
  clipNamed(fitting, name);
}

}  // namespace

RigOptions rigOptions(const InferOptions& options) {
  RigOptions rig;
  const RigOptions plans = skel::rigOptions(options.body_plan);
  rig.body_plan = plans.body_plan;
  rig.otherwise = plans.otherwise;
  rig.mlp = options.weights_file.empty() ? defaultMlp() : readMlp(options.weights_file);
  rig.recognizer = kRecognizerNames.at(options.recognizer);
  rig.upright = options.upright;
  // The paper keeps the outer contour alone.
  rig.silhouette.fill_holes = rig.recognizer == Recognizer::kPaper;
  rig.candidates.method = kCandidateNames.at(options.candidates);
  rig.skin_method = kSkinNames.at(options.skin);
  rig.skin.max_influences = options.max_influences;
  rig.inflate.spacing_px = options.mesh_spacing_px;
  if (options.back == "same") rig.back = Back::kSame;
  if (options.back == "plain") rig.back = Back::kPlain;
  rig.height_m = options.height_m;
  rig.layers = options.layers != "off";
  rig.into_picture = options.into_picture;
  rig.rest_pose = kRestPoseNames.at(options.rest_pose);
  if (!options.joint_net_file.empty())
    rig.joint_net = std::make_shared<const JointNet>(
        readyToRun(parseJointNet(readFile(options.joint_net_file), options.joint_net_file)));
  if (!options.part_net_file.empty())
    rig.part_net = std::make_shared<const PartNet>(
        readyToRun(parsePartNet(readFile(options.part_net_file), options.part_net_file)));
  const std::vector<Clip> library =
      options.clips_dir.empty() ? builtinClips() : clipsWithFolder(options.clips_dir);
  for (const std::string& name : options.clips)
    if (name != "none" || options.clips.size() > 1) requireClip(library, rig, name);
  rig.clips = askedClips(library, rig.body_plan, options.clips);
  if (rig.otherwise) rig.otherwise->clips = askedClips(library, rig.otherwise->body_plan, options.clips);
  return rig;
}

void noteUnusedWeights(const InferOptions& options) {
  const auto& formats = options.formats;
  if (options.weights_file.empty() || options.recognizer == "paper" ||
      std::find(formats.begin(), formats.end(), "features") != formats.end())
    return;
  std::fprintf(stderr,
               "skel-infer: note: the joints come from the recognizer \"%s\", which has a net of its own; "
               "--weights needs --recognizer paper or --formats features\n",
               options.recognizer.c_str());
}

}  // namespace skel
