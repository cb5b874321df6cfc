#include "animator/clip_source.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "animator/pose_file.h"
#include "libskel/animation/arm_abilities.h"
#include "libskel/animation/clip_file.h"
#include "libskel/animation/clip_library.h"
#include "libskel/animation/keyframe_clip.h"
#include "libskel/animation/pose_hash.h"
#include "libskel/animation/retarget.h"
#include "libskel/animation/role_figure.h"
#include "libskel/cli/number.h"
#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/core/files.h"
#include "libskel/core/text.h"
#include "libskel/core/tool_command.h"
#include "libskel/deform/measure_figure.h"
#include "libskel/pipeline/facing.h"
#include "libskel/skeleton/hanging.h"
#include "libskel/skeleton/joint_lookup.h"

namespace skel {
namespace {

// The figure's own flesh, as it would be on the skeleton with our names.
FigureShape measureByRoles(const RiggedCharacter& character, const RoleFigure& figure) {
  TriangleMesh mesh = character.mesh;
  mesh.vertices = (mesh.vertices * figure.to_ours.toRotationMatrix().transpose().cast<float>()).eval();
  SkinWeights weights = character.weights;
  for (Eigen::Index v = 0; v < weights.joints.rows(); ++v)
    for (Eigen::Index k = 0; k < weights.joints.cols(); ++k)
      weights.joints(v, k) = static_cast<std::uint16_t>(figure.carriers[std::size_t(weights.joints(v, k))]);
  return measureFigure(mesh, weights, figure.skeleton);
}

// By their own names, though the skeleton has not all joints of the clip's template.
bool fitsByNames(Clip clip, const Skeleton& skeleton) {
  clip.template_name.clear();
  return fits(clip, skeleton);
}

// "": neither a template's nor one that could be told.
std::string bodyPlanOf(const Skeleton& skeleton) {
  if (!skeleton.template_name.empty()) return skeleton.template_name;
  const std::optional<RoleFigure> figure = roleFigure(skeleton);
  return figure ? figure->skeleton.template_name : "";
}

// Made for another body plan, not all of whose joints the skeleton has.
bool isForOther(const Clip& clip, const Skeleton& skeleton) {
  if (clip.template_name.empty() || fits(clip, skeleton)) return false;
  const std::string body_plan = bodyPlanOf(skeleton);
  return !body_plan.empty() && body_plan != clip.template_name;
}

// The character's parts, where it does the clip by these and not by the names of its joints.
std::optional<RoleFigure> partsFor(const Clip& clip, const Skeleton& skeleton) {
  if (fits(clip, skeleton)) return std::nullopt;
  std::optional<RoleFigure> figure = roleFigure(skeleton);
  if (!figure || fits(clip, *figure)) return figure;
  const bool by_names = !skeleton.template_name.empty() || fitsByNames(clip, skeleton);
  if (by_names || !isForOther(clip, skeleton) || !hasParts(clip, *figure)) return std::nullopt;
  return figure;
}

// Of a clip for another body plan what our own skeleton can do of it, by the names of its joints; or nothing.
std::optional<Clip> commonPart(Clip clip, const Skeleton& skeleton) {
  if (!isForOther(clip, skeleton) || !faultOf(clip, skeleton).empty()) return std::nullopt;
  if (!skeleton.template_name.empty())
    std::erase_if(clip.tracks, [&](const JointTrack& track) { return skeleton.find(track.joint) < 0; });
  clip.template_name.clear();
  if (clip.tracks.empty() || !fits(clip, skeleton)) return std::nullopt;
  return clip;
}

// What is wrong with a clip that calls some joints as the character does and some as we do; "": nothing.
std::string mixedNames(const Clip& clip, const Skeleton& skeleton, const RoleFigure& figure) {
  const JointLookup theirs(skeleton), ours(figure.skeleton);
  std::string own, other;
  for (const JointTrack& track : clip.tracks) {
    const bool is_own = theirs.find(track.joint) >= 0, is_ours = ours.find(track.joint) >= 0;
    if (is_own && !is_ours) own = track.joint;
    if (is_ours && !is_own) other = track.joint;
  }
  if (own.empty() || other.empty()) return "";
  return "calls some joints as this character does (\"" + own + "\") and some as skel does (\"" + other +
         "\", here \"" + skeleton.joints[std::size_t(figure.theirs[std::size_t(ours.find(other))])].name +
         "\"); call all by one kind of names";
}

double intoPicture(const ClipSource& source, ClipFrame frame) {
  return source.flat && !source.into_picture_given && frame == ClipFrame::kBody ? 1 : source.into_picture;
}

}  // namespace

void bindClipSource(CLI::App& app, ClipSource& source) {
  app.add_option("--clips-dir", source.clips_dir,
                 "A folder of clip files (.clip.json) beside those that come with skel")
      ->type_name("DIR");
  app.add_option("--interpolation", source.interpolation,
                 "How joints turn between the keys of a key-frame clip: slerp, or linear on its angles")
      ->check(CLI::IsMember({"slerp", "linear"}))
      ->capture_default_str();
  app.add_option("--clip-up", source.clip_up, "The axis of a key-frame clip that points up")
      ->check(CLI::IsMember({"y", "z"}))
      ->capture_default_str();
  app.add_option("--into-picture", source.into_picture,
                 "How far limbs that point at the viewer turn into the picture, of figures drawn from the "
                 "front: 0 not at all, 1 all the way")
      ->check(numberIn(0.0, 1.0))
      ->each([&source](const std::string&) { source.into_picture_given = true; })
      ->capture_default_str();
}

std::vector<Clip> clipLibrary(const ClipSource& source, std::vector<std::string>* left_out) {
  return clipsWithFolder(source.clips_dir, source.names, left_out);
}

std::string clipFileNamed(const std::string& name, const ClipSource& source) {
  if (source.clips_dir.empty()) return "";
  for (const std::string& path : filesBelow(source.clips_dir))
    if (path.ends_with(kClipFileEnding) && clipNameIn(path) == name) return path;
  return "";
}

std::vector<Clip> toldClipLibrary(const ClipSource& source) {
  std::vector<std::string> left_out;
  std::vector<Clip> library = clipLibrary(source, &left_out);
  for (const std::string& problem : left_out)
    std::fprintf(stderr, "skel-animate: note: left out: %s\n", printable(problem).c_str());
  return library;
}

std::vector<Clip> clipsFor(const std::vector<Clip>& library, const RiggedCharacter& character) {
  std::vector<Clip> fitting = clipsFor(library, character.skeleton);
  if (const std::optional<RoleFigure> figure = roleFigure(character.skeleton))
    for (const Clip& clip : library)
      if (!fits(clip, character.skeleton) &&
          (fits(clip, *figure) || (isFor(clip, *figure) && fitsByNames(clip, character.skeleton))))
        fitting.push_back(clip);
  return fitting;
}

std::string whyUnfit(const Clip& clip, const RiggedCharacter& character) {
  if (std::string fault = faultOf(clip, character.skeleton); !fault.empty()) return fault;
  const std::optional<RoleFigure> figure = roleFigure(character.skeleton);
  if (std::string fault = figure ? mixedNames(clip, character.skeleton, *figure) : std::string();
      !fault.empty())
    return fault;
  const JointLookup joints(character.skeleton);
  const auto lacks = [&](const std::string& joint) {
    return joints.find(joint) < 0 && !isHangingName(joint) && !(figure && figure->skeleton.find(joint) >= 0);
  };
  const std::string body_plan = bodyPlanOf(character.skeleton);
  const bool is_other = isForOther(clip, character.skeleton);
  const std::string other =
      is_other ? "is for a " + clip.template_name + ", this is a " + body_plan + ": the clip " : "";
  for (const FootContact& contact : clip.contacts)
    if (is_other && lacks(contact.joint))
      return other + "puts \"" + contact.joint + "\" on the ground, which a " + body_plan +
             " lacks; without \"contacts\" its file plays as far as it fits";
  if (is_other && std::any_of(clip.tracks.begin(), clip.tracks.end(),
                              [&](const JointTrack& track) { return !lacks(track.joint); }))
    return other + "plays as far as it fits where its file is named (--clip FILE)";
  for (const JointTrack& track : clip.tracks)
    if (lacks(track.joint)) return other + "moves \"" + track.joint + "\", which this character lacks";
  for (const FootContact& contact : clip.contacts)
    if (lacks(contact.joint))
      return "puts \"" + contact.joint + "\" on the ground, which this character lacks";
  return "";
}

ClipNotes whatStays(const std::vector<Clip>& clips, const RiggedCharacter& character) {
  ClipNotes notes;
  std::optional<RoleFigure> figure;
  std::vector<Clip> by_names, by_parts;
  for (const Clip& clip : clips) {
    if (isForOther(clip, character.skeleton))
      notes.of_character.push_back("is a " + bodyPlanOf(character.skeleton) + ", the clip \"" + clip.name +
                                   "\" is for a " + clip.template_name);
    std::optional<RoleFigure> parts = partsFor(clip, character.skeleton);
    const Skeleton& skeleton = parts ? parts->skeleton : character.skeleton;
    std::vector<std::string> lacking;
    for (const JointTrack& track : clip.tracks)
      if (skeleton.find(track.joint) < 0 && !isHangingName(track.joint))
        lacking.push_back('"' + track.joint + '"');
    if (!lacking.empty())
      notes.of_character.push_back("the clip \"" + clip.name + "\" plays without " + joined(lacking) +
                                   ", which this character lacks");
    (parts ? by_parts : by_names).push_back(clip);
    if (parts) figure = std::move(parts);
  }
  const auto addArms = [&](std::vector<std::string> arms) {
    notes.of_arms.insert(notes.of_arms.end(), arms.begin(), arms.end());
  };
  if (!by_names.empty())
    addArms(
        armsThatStay(by_names, character.skeleton,
                     measureFigure(character.mesh, character.weights, character.skeleton, character.facing)));
  if (!by_parts.empty())
    addArms(armsThatStay(by_parts, figure->skeleton, measureByRoles(character, *figure)));
  return notes;
}

Clip fitted(const Clip& clip, const RiggedCharacter& character, const ClipSource& source) {
  if (const std::optional<RoleFigure> figure = partsFor(clip, character.skeleton))
    return retargetByRoles(clip, *figure, character.skeleton, measureByRoles(character, *figure));
  RetargetOptions options;
  options.shape = measureFigure(character.mesh, character.weights, character.skeleton, character.facing);
  options.into_picture = intoPicture(source, clip.frame);
  return retargetToRest(commonPart(clip, character.skeleton).value_or(clip), character.skeleton, options);
}

ClipKeys madeFor(const Skeleton& skeleton, ClipKeys keys) {
  keys.clip.rest_pose = restPoseHash(skeleton);
  if (keys.clip.template_name.empty()) keys.clip.template_name = skeleton.template_name;
  return keys;
}

RetargetedMotion loadBvhFor(const std::string& path, const RiggedCharacter& character,
                            const ClipSource& source) {
  return retargetMotion(
      readBvh(path), path, character.skeleton,
      measureFigure(character.mesh, character.weights, character.skeleton, character.facing),
      {intoPicture(source, ClipFrame::kBody), source.flat});
}

namespace {

// What a clip that somebody has made on a figure seen from the front, in the picture's directions, does to
// one that looks aside: a bow goes to the viewer. Nothing where it fits.
std::optional<std::string> aslantNote(const Clip& clip, const RiggedCharacter& character) {
  constexpr double kAside_rad = 0.5, kBend_rad = 0.2;
  const double yaw_rad = facing(character);
  if (clip.frame != ClipFrame::kPicture || isRelativeTo(clip, character.skeleton) ||
      std::abs(yaw_rad) < kAside_rad)
    return std::nullopt;
  double forward = 0, aside = 0;
  for (const JointTrack& track : clip.tracks) {
    if (track.joint != "body" && track.joint != "neck" && track.joint != "head" && track.joint != "pelvis")
      continue;
    for (const Eigen::Quaternionf& turn : track.rotations) {
      const Eigen::AngleAxisf about(turn);
      const Eigen::Vector3f turned = about.angle() * about.axis();
      forward = std::max(forward, double(std::abs(turned.x())));
      aside = std::max(aside, double(std::abs(turned.z())));
    }
  }
  if (forward < kBend_rad || forward < aside) return std::nullopt;
  return "the clip \"" + clip.name + "\" bends towards the viewer, and this is " + drawnFrom(yaw_rad) +
         ": \"frame\": \"body\" in its file has each figure bend to where it looks";
}

bool isBvh(const std::string& path) { return path.ends_with(".bvh") || path.ends_with(".BVH"); }

std::string stemOfPose(const std::string& path) {
  const std::string name = std::filesystem::path(path).filename().string();
  return name.substr(0, name.ends_with(kPoseFileEnding) ? name.size() - std::string(kPoseFileEnding).size()
                                                        : name.rfind('.'));
}

// What is to be said of a person's motion for an animal.
std::string otherBodyPlan(const RetargetedMotion& motion, const std::string& path,
                          const RiggedCharacter& character) {
  const std::string body_plan = bodyPlanOf(character.skeleton);
  if (body_plan.empty() || body_plan == "biped" || motion.match.ours_left.empty()) return "";
  return "is a " + body_plan + ", " + path + " a biped's motion: it moves " +
         std::to_string(motion.match.joints.size()) + " of " +
         std::to_string(character.skeleton.joints.size()) + " joints (skel-animate retarget says which)";
}

Clip readClipFor(const std::string& path, const RiggedCharacter& character, const ClipSource& source,
                 ClipNotes* notes) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (isBvh(path)) {
    RetargetedMotion motion = loadBvhFor(path, character, source);
    if (const std::string clause = otherBodyPlan(motion, path, character); notes && !clause.empty())
      notes->of_character.push_back(clause);
    if (notes && motion.match.by_shape)
      notes->of_character.push_back(
          "the joints of " + path +
          " are matched by the shape of the tree, which may be wrong, as their names "
          "tell too little (skel-animate retarget says what was matched)");
    if (notes) notes->of_arms = std::move(motion.arms_that_stay);
    return std::move(motion.clip);
  }
  if (ending == ".glb" || ending == ".GLB")
    throw InputError(path, "is a character, no motion; write the clip that you want of it first, `" +
                               toolCommand("skel-animate") + " retarget CLIP --to " + shellWord(path) +
                               " -o CLIP.bvh`, and give CLIP.bvh instead");
  const std::string text = readFile(path);
  if (isKeyframeClip(text)) {
    KeyframeClipOptions options;
    options.z_up = source.clip_up == "z";
    if (source.interpolation == "linear") options.interpolation = RotationInterpolation::kAngles;
    return parseKeyframeClip(text, path, character.skeleton, options, notes ? &notes->of_file : nullptr);
  }
  if (isPoseFile(text))
    return clipOfPose(parsePose(text, path, character.skeleton), character.skeleton, stemOfPose(path));
  const Clip clip = parseClip(text, path);
  if (!partsFor(clip, character.skeleton) && !commonPart(clip, character.skeleton))
    if (const std::string fault = whyUnfit(clip, character); !fault.empty()) {
      if (isForOther(clip, character.skeleton)) throw OtherBodyPlan(path, fault);
      throw InputError(path, fault);
    }
  if (notes) {
    *notes = whatStays({clip}, character);
    if (std::optional<std::string> note = aslantNote(clip, character))
      notes->of_character.push_back(std::move(*note));
  }
  return fitted(clip, character, source);
}

}  // namespace

Clip loadClipFor(const std::string& path, const RiggedCharacter& character, const ClipSource& source,
                 ClipNotes* notes) {
  try {
    return readClipFor(path, character, source, notes);
  } catch (const InputError&) {
    throw;
  } catch (const Error& error) {  // of the clip, whatever file it is from
    if (error.exitCode() != ExitCode::kInput) throw;
    throw InputError(path, error.what());
  }
}

std::optional<ClipKeys> easedKeysIn(const std::string& path) {
  if (isBvh(path)) return std::nullopt;
  const std::string text = readFile(path);
  if (isKeyframeClip(text) || isPoseFile(text)) return std::nullopt;
  ClipKeys keys = parseClipKeys(text, path);
  return keys.ease == KeyEase::kNone ? std::nullopt : std::optional(std::move(keys));
}

std::optional<ClipKeys> easedKeysOf(const std::string& path, const Skeleton& skeleton) {
  std::optional<ClipKeys> keys = easedKeysIn(path);
  if (!keys || keys->clip.rest_pose != restPoseHash(skeleton)) return std::nullopt;
  keys->clip.rest_pose.clear();
  return keys;
}

std::vector<ClipKeys> easedKeysOf(const ClipSource& source, const Skeleton& skeleton) {
  std::vector<ClipKeys> eased;
  if (source.clips_dir.empty()) return eased;
  for (const std::string& path : filesBelow(source.clips_dir)) {
    if (!path.ends_with(kClipFileEnding)) continue;
    try {
      if (std::optional<ClipKeys> keys = easedKeysOf(path, skeleton)) eased.push_back(std::move(*keys));
    } catch (const InputError&) {
    }
  }
  return eased;
}

}  // namespace skel
