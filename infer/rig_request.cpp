#include "infer/rig_request.h"

#include <algorithm>
#include <cstdio>

#include "infer/outputs.h"
#include "libskel/animation/clip_file.h"
#include "libskel/animation/clip_library.h"
#include "libskel/classifier/weights_file.h"
#include "libskel/core/file_names.h"
#include "libskel/core/files.h"
#include "libskel/core/text.h"
#include "libskel/core/tool_command.h"
#include "libskel/jointnet/net_joints.h"
#include "libskel/pipeline/rig_drawing.h"

namespace skel {
namespace {

const Clip* find(const std::vector<Clip>& clips, const std::string& name) {
  const auto found =
      std::find_if(clips.begin(), clips.end(), [&](const Clip& clip) { return clip.name == name; });
  return found == clips.end() ? nullptr : &*found;
}

// Those of these names, in their order, each once.
std::vector<Clip> named(const std::vector<Clip>& clips, const std::vector<std::string>& names) {
  std::vector<Clip> some;
  for (const std::string& name : names)
    if (const Clip* clip = find(clips, name); clip && !find(some, name)) some.push_back(*clip);
  return some;
}

std::vector<Clip> clipLibrary(const InferOptions& options) {
  std::vector<std::string> left_out;
  std::vector<Clip> library = clipsWithFolder(options.clips_dir, options.clips, &left_out);
  for (const std::string& problem : left_out)
    std::fprintf(stderr, "skel-infer: note: left out: %s\n", printable(problem).c_str());
  return library;
}

// Throws UsageError where a file is named instead of a clip: how such a motion comes into a character.
void refuseFile(const std::string& name) {
  if (name.ends_with(kClipFileEnding))
    throw UsageError("--clips takes names of clips, \"" + name +
                     "\" is a file; name its folder by --clips-dir, and the clip in it by its name");
  if (name.find_first_of("./") != std::string::npos)
    throw UsageError("--clips takes names of clips, \"" + name + "\" is a file; after the rig: `" +
                     toolCommand("skel-animate") + " retarget " + shellWord(name) + " --to FILE.glb`");
}

// What is wrong with it for either body plan; see faultOf().
std::string faultFor(const Clip& clip, const RigOptions& rig) {
  if (rig.otherwise && faultOf(clip, rig.otherwise->body_plan).empty()) return "";
  return faultOf(clip, rig.body_plan);
}

// Of a clip without a fault that does not fit.
std::string whyNotFor(const Clip& clip, const SkeletonTemplate& body_plan) {
  for (const JointTrack& track : clip.tracks)
    if (body_plan.find(track.joint) < 0)
      return "moves \"" + track.joint + "\", which the template \"" + body_plan.name + "\" lacks";
  return "does not fit the template \"" + body_plan.name + '"' +
         (clip.template_name.empty() ? "" : ": it is made for \"" + clip.template_name + '"');
}

// Says which of the user's own clips can be no figure's.
void noteFaults(const std::vector<Clip>& library, const RigOptions& rig) {
  for (const Clip& clip : library)
    if (const std::string fault = isOwn(clip) ? faultFor(clip, rig) : std::string(); !fault.empty())
      std::fprintf(stderr, "skel-infer: note: left out: the clip \"%s\" %s\n", printable(clip.name).c_str(),
                   printable(fault).c_str());
}

// Throws UsageError where a name is that of no clip of either body plan, or of one with a fault.
void keepClips(const std::vector<std::string>& names, const std::vector<Clip>& library, RigOptions& rig) {
  std::vector<Clip> all = rig.clips;
  if (rig.otherwise)
    for (const Clip& clip : rig.otherwise->clips)
      if (!find(all, clip.name)) all.push_back(clip);
  for (const std::string& name : names) {
    if (!find(all, name)) refuseFile(name);
    for (const Clip& clip : library)
      if (const std::string fault = clip.name == name && isOwn(clip) ? faultFor(clip, rig) : std::string();
          !fault.empty())
        throw UsageError("the clip \"" + name + "\" " + fault);
    if (!rig.otherwise && !find(all, name))
      if (const Clip* clip = find(library, name); clip && isOwn(*clip))
        throw UsageError("the clip \"" + name + "\" " + whyNotFor(*clip, rig.body_plan));
    clipNamed(all, name);
  }
  rig.clips = named(rig.clips, names);
  if (rig.otherwise) rig.otherwise->clips = named(rig.otherwise->clips, names);
}

// Throws UsageError where it is a net of another body plan.
std::shared_ptr<const JointNet> jointNetFor(const std::string& file, const SkeletonTemplate& body_plan) {
  JointNet net = parseJointNet(readFile(file), file);
  try {
    netJoints(net.joints, body_plan);
  } catch (const UsageError& error) {
    if (net.body_plan == body_plan.name)
      throw UsageError("--joint-net " + shellWord(file) + ": " + error.what());
    throw UsageError("--joint-net " + shellWord(file) + " is a net of the template \"" + net.body_plan +
                     "\", joints of the template \"" + body_plan.name +
                     "\" are looked for; name the template by --template " + shellWord(net.body_plan) +
                     ", or another net");
  }
  return std::make_shared<const JointNet>(readyToRun(std::move(net)));
}

}  // namespace

RigOptions rigOptions(const InferOptions& options) {
  RigOptions rig = rigOptionsWithoutClips(options.body_plan);
  rig.last = lastStageFor(options);
  rig.mlp = options.weights_file.empty() ? defaultMlp() : readMlp(options.weights_file);
  rig.recognizer = kRecognizerNames.at(options.recognizer);
  rig.upright = options.upright;
  rig.silhouette.alpha = options.alpha;
  // The paper keeps the outer contour alone.
  rig.silhouette.fill_holes = rig.recognizer == Recognizer::kPaper;
  rig.candidates.method = kCandidateNames.at(options.candidates);
  rig.skin_method = kSkinNames.at(options.skin);
  rig.skin.max_influences = options.max_influences;
  rig.inflate.spacing_px = options.mesh_spacing_px;
  if (options.back == "same") rig.back = Back::kSame;
  if (options.back == "plain") rig.back = Back::kPlain;
  rig.height_m = options.heights.of_others;
  rig.layers = options.layers != "off";
  rig.cut_limbs = options.cut_limbs;
  rig.into_picture = options.into_picture;
  rig.rest_pose = kRestPoseNames.at(options.rest_pose);
  if (!options.joint_net_file.empty()) rig.joint_net = jointNetFor(options.joint_net_file, rig.body_plan);
  if (!options.part_net_file.empty())
    rig.part_net = std::make_shared<const PartNet>(
        readyToRun(parsePartNet(readFile(options.part_net_file), options.part_net_file)));
  if (options.clips != std::vector<std::string>{"none"}) {
    const std::vector<Clip> library = clipLibrary(options);
    rig.clips = clipsFor(library, rig.body_plan);
    if (rig.otherwise) rig.otherwise->clips = clipsFor(library, rig.otherwise->body_plan);
    if (options.clips.empty())
      noteFaults(library, rig);
    else
      keepClips(options.clips, library, rig);
  }
  return rig;
}

void noteUnusedWeights(const InferOptions& options) {
  if (!options.joint_net_file.empty() && options.recognizer == "paper")
    std::fprintf(
        stderr,
        "skel-infer: note: the recognizer \"paper\" has no use for a net of joints; --joint-net needs "
        "--recognizer tree\n");
  const auto& formats = options.formats;
  if (options.weights_file.empty() || options.recognizer == "paper" || !options.trace_dir.empty() ||
      std::find(formats.begin(), formats.end(), "features") != formats.end())
    return;
  std::fprintf(stderr,
               "skel-infer: note: the joints come from the recognizer \"%s\", which has a net of its own; "
               "--weights needs --recognizer paper, --formats features or --trace\n",
               options.recognizer.c_str());
}

}  // namespace skel
