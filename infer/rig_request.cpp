#include "infer/rig_request.h"

#include <algorithm>
#include <cstdio>

#include "libskel/animation/clip_library.h"
#include "libskel/classifier/weights_file.h"
#include "libskel/core/files.h"

namespace skel {

RigOptions rigOptions(const InferOptions& options) {
  RigOptions rig;
  rig.body_plan = loadTemplate(options.body_plan);
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
  rig.rest_pose = kRestPoseNames.at(options.rest_pose);
  if (!options.joint_net_file.empty())
    rig.joint_net = std::make_shared<const JointNet>(
        readyToRun(parseJointNet(readFile(options.joint_net_file), options.joint_net_file)));
  if (!options.part_net_file.empty())
    rig.part_net = std::make_shared<const PartNet>(
        readyToRun(parsePartNet(readFile(options.part_net_file), options.part_net_file)));
  const std::vector<Clip> clips = clipsFor(
      options.clips_dir.empty() ? builtinClips() : clipsWithFolder(options.clips_dir), rig.body_plan);
  if (options.clips.empty())
    rig.clips = clips;
  else if (options.clips != std::vector<std::string>{"none"})
    for (std::size_t i = 0; i < options.clips.size(); ++i)
      if (const auto asked = options.clips.begin(); std::find(asked, asked + i, asked[i]) == asked + i)
        rig.clips.push_back(clipNamed(clips, asked[i]));
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
