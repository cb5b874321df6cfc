#include "libskel/animation/clip_library.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "embedded/builtin_clip_files.h"
#include "libskel/animation/clip_file.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/nearest_word.h"
#include "libskel/core/text.h"
#include "libskel/skeleton/hanging.h"

namespace skel {
namespace {

// Of a skeleton or a template: whether the joint ends a limb of two bones, as what stands on the ground must.
template <class Target>
bool endsLimb(const Target& target, const std::string& joint) {
  const int foot = target.find(joint);
  const int knee = foot < 0 ? -1 : target.joints[std::size_t(foot)].parent;
  return knee >= 0 && target.joints[std::size_t(knee)].parent >= 0;
}

template <class Target>
bool fitsTarget(const Clip& clip, const std::string& template_name, const Target& target) {
  const auto has_joint = [&](const std::string& joint) { return target.find(joint) >= 0; };
  const bool moves_all =
      std::all_of(
          clip.tracks.begin(), clip.tracks.end(),
          [&](const JointTrack& track) { return has_joint(track.joint) || isHangingName(track.joint); }) &&
      std::all_of(clip.contacts.begin(), clip.contacts.end(),
                  [&](const FootContact& contact) { return endsLimb(target, contact.joint); });
  if (!moves_all || clip.template_name.empty() || clip.template_name == template_name) return moves_all;
  const std::vector<std::string> known = builtinTemplates();
  if (std::find(known.begin(), known.end(), clip.template_name) == known.end()) return false;
  const SkeletonTemplate made_for = loadTemplate(clip.template_name);
  return std::all_of(made_for.joints.begin(), made_for.joints.end(),
                     [&](const TemplateJoint& joint) { return has_joint(joint.name); });
}

template <class Target>
std::vector<Clip> fittingClips(const std::vector<Clip>& library, const Target& target) {
  std::vector<Clip> fitting;
  for (const Clip& clip : library)
    if (fits(clip, target)) fitting.push_back(clip);
  return fitting;
}

// `lacking`: who, after "which".
template <class Target>
std::string faultFor(const Clip& clip, const Target& target, const std::string& lacking) {
  if (fits(clip, target)) return "";
  const std::vector<std::string> templates = builtinTemplates();
  if (!clip.template_name.empty() &&
      std::find(templates.begin(), templates.end(), clip.template_name) == templates.end())
    return "is made for the template \"" + clip.template_name +
           "\", which is not known; there are: " + joined(templates);
  std::vector<std::string> known;
  for (const auto& joint : target.joints) known.push_back(joint.name);
  for (const std::string& name : templates)
    if (clip.template_name.empty() || clip.template_name == name)
      for (const TemplateJoint& joint : loadTemplate(name).joints) known.push_back(joint.name);
  const auto isKnown = [&](const std::string& joint) {
    return isHangingName(joint) || std::find(known.begin(), known.end(), joint) != known.end();
  };
  const auto lacks = [&](const std::string& joint) {
    const std::string meant = nearestWord(joint, known);
    return ", which " + lacking + (meant.empty() ? "" : "; did you mean \"" + meant + "\"?");
  };
  for (const JointTrack& track : clip.tracks)
    if (!isKnown(track.joint)) return "moves \"" + track.joint + '"' + lacks(track.joint);
  for (const FootContact& contact : clip.contacts)
    if (!isKnown(contact.joint)) return "puts \"" + contact.joint + "\" on the ground" + lacks(contact.joint);
  return "";
}

// Whether a body plan that `other` was made for can do `clip` under the same name.
bool takesThePlaceOf(const Clip& clip, const Clip& other) {
  if (clip.name != other.name) return false;
  if (clip.template_name == other.template_name) return true;
  const std::vector<std::string> known = builtinTemplates();
  return clip.template_name.empty() &&
         std::find(known.begin(), known.end(), other.template_name) != known.end() &&
         fits(clip, loadTemplate(other.template_name));
}

std::string templateOf(const Clip& a, const Clip& b) {
  const std::string& name = a.template_name.empty() ? b.template_name : a.template_name;
  return name.empty() ? "any template" : "the template \"" + name + "\"";
}

}  // namespace

const std::vector<Clip>& builtinClips() {
  static const std::vector<Clip> clips = [] {
    std::vector<Clip> all;
    for (const auto& [name, text] : embedded::builtin_clip_files)
      all.push_back(parseClip(text, std::string(name)));
    return all;
  }();
  return clips;
}

bool hasClip(const std::vector<Clip>& clips, const std::string& name) {
  return std::any_of(clips.begin(), clips.end(), [&](const Clip& clip) { return clip.name == name; });
}

bool isOwn(const Clip& clip) {
  return std::find(builtinClips().begin(), builtinClips().end(), clip) == builtinClips().end();
}

namespace {

bool isNeeded(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::vector<Clip> clipsWithFolder(const std::string& dir, const std::vector<std::string>& names,
                                  std::vector<std::string>* left_out) {
  if (dir.empty()) return builtinClips();
  std::vector<Clip> library = builtinClips();
  std::vector<Clip> own;
  std::vector<std::string> files;  // of `own`
  std::optional<InputError> broken;
  for (const std::string& path : filesBelow(dir)) {
    if (!path.ends_with(kClipFileEnding)) continue;
    Clip clip;
    try {
      clip = readClipFile(path);
    } catch (const InputError& error) {
      if (isNeeded(clipNameIn(path), names)) throw;
      if (left_out) left_out->push_back(error.what());
      if (!broken) broken = error;
      continue;
    }
    const auto other = std::find_if(own.begin(), own.end(), [&](const Clip& one) {
      return takesThePlaceOf(clip, one) || takesThePlaceOf(one, clip);
    });
    if (other != own.end()) {
      const InputError second(path, "is the second clip \"" + clip.name + "\" for " +
                                        templateOf(clip, *other) + ", after " +
                                        files[std::size_t(other - own.begin())] +
                                        "; change \"name\" in one of them, or remove it");
      if (isNeeded(clip.name, names)) throw second;
      if (left_out) left_out->push_back(second.what());
      continue;
    }
    own.push_back(std::move(clip));
    files.push_back(path);
  }
  if (own.empty() && broken) throw *broken;
  if (own.empty())
    throw InputError(dir, "holds no clip; the files must end in " + std::string(kClipFileEnding));
  for (Clip& clip : own) {
    // One clip may stand for those of several body plans.
    const auto known = std::find_if(library.begin(), library.end(),
                                    [&](const Clip& other) { return takesThePlaceOf(clip, other); });
    const auto place = known - library.begin();
    std::erase_if(library, [&](const Clip& other) { return takesThePlaceOf(clip, other); });
    library.insert(library.begin() + place, std::move(clip));
  }
  return library;
}

bool fits(const Clip& clip, const Skeleton& skeleton) {
  return fitsTarget(clip, skeleton.template_name, skeleton);
}

bool fits(const Clip& clip, const SkeletonTemplate& body_plan) {
  return fitsTarget(clip, body_plan.name, body_plan);
}

std::string faultOf(const Clip& clip, const Skeleton& skeleton) {
  return faultFor(clip, skeleton, "this character lacks");
}

std::string faultOf(const Clip& clip, const SkeletonTemplate& body_plan) {
  return faultFor(
      clip, body_plan,
      clip.template_name.empty() ? "no template has" : "the template \"" + clip.template_name + "\" lacks");
}

std::vector<Clip> clipsFor(const std::vector<Clip>& library, const Skeleton& skeleton) {
  return fittingClips(library, skeleton);
}

std::vector<Clip> clipsFor(const std::vector<Clip>& library, const SkeletonTemplate& body_plan) {
  return fittingClips(library, body_plan);
}

std::string meantClip(std::string_view name, const std::vector<Clip>& fitting) {
  constexpr std::pair<std::string_view, std::string_view> kSameGaits[] = {{"run", "gallop"},
                                                                          {"gallop", "run"}};
  for (const auto& [one, other] : kSameGaits)
    if (name == one && hasClip(fitting, std::string(other))) return std::string(other);
  std::vector<std::string> names;
  for (const Clip& clip : fitting) names.push_back(clip.name);
  return nearestWord(name, names);
}

const Clip& clipNamed(const std::vector<Clip>& fitting, std::string_view name) {
  std::vector<std::string> names;
  for (const Clip& clip : fitting) {
    if (clip.name == name) return clip;
    if (std::find(names.begin(), names.end(), clip.name) == names.end()) names.push_back(clip.name);
  }
  const std::string meant = meantClip(name, fitting);
  throw UsageError("there is no clip \"" + std::string(name) + "\" for this body plan" +
                   (meant.empty() ? "" : "; did you mean \"" + meant + "\"?") +
                   (names.empty() ? "" : (meant.empty() ? "; there are: " : " There are: ") + joined(names)));
}

}  // namespace skel
