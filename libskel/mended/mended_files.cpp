#include "libskel/mended/mended_files.h"

#include <algorithm>
#include <filesystem>

#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/sha256.h"
#include "libskel/core/text.h"
#include "libskel/core/tool_command.h"
#include "libskel/image/read_image.h"
#include "libskel/image/sealed_png.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/labels/label_file.h"
#include "libskel/mended/earlier_picture.h"
#include "libskel/mended/former_names.h"
#include "libskel/mended/mend_places.h"
#include "libskel/pipeline/rig_drawing.h"
#include "libskel/silhouette/outline.h"
#include "libskel/skeleton/body_plans.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

std::string ifThere(const std::string& path) {
  std::error_code unknown;
  return fs::is_regular_file(path, unknown) ? path : "";
}

// Without an ending: what is made of another figure than the first has its number, unless that is the name of
// a drawing. "": nothing can be made of it there.
std::string madeOf(const MendPlace& place, int figure) {
  const std::string made = stemOfFigure(place.made, figure);
  return figure > 1 && pictureOfStem(made) ? "" : made;
}

std::string backIn(const MendPlace& place) {
  for (const char* ending : {".back.png", ".back.jpg", ".back.jpeg"})
    if (const std::string back = ifThere(place.made + ending); !back.empty()) return back;
  return "";
}

// Not of a file that cannot be read.
bool areOfPicture(const std::string& labels, const MendRequest& request) {
  if (ifThere(labels).empty()) return false;
  try {
    return request.isOfPicture(readLabelFile(labels).image.sha256);
  } catch (const InputError&) {
    return false;
  }
}

// Beside it lies what to learn from or to measure by, which nobody has mended.
bool isAnnotated(const std::string& drawing) {
  return fs::exists(fs::path(drawing).replace_extension(".joints.json"));
}

bool sameBytes(const std::string& path, const std::string& other_path) {
  const LookAtOutputs look;
  return readFile(path) == readFile(other_path);
}

using AreSame = bool (*)(const std::string& path, const std::string& other_path);

// The first that is there is taken.
void offer(std::string& taken, const std::string& path, AreSame are_same, MendedFiles& files) {
  if (ifThere(path).empty()) return;
  if (taken.empty())
    taken = path;
  else if (std::error_code unknown; !fs::equivalent(taken, path, unknown) && !are_same(taken, path))
    files.passed_over.push_back({path, taken});
}

void offerResult(std::string& taken, const std::string& path, const MendPlace& place, AreSame are_same,
                 MendedFiles& files) {
  if (place.is_earlier)
    files.earlier.push_back(path);
  else
    offer(taken, path, are_same, files);
}

// That tells whether the picture has changed.
std::optional<SkeletonSource> resultAmong(const std::vector<MendPlace>& places) {
  for (const MendPlace& place : places)
    if (place.result) return place.result;
  return std::nullopt;
}

// Painted since the result was written, or before, when its skeleton file took it for its mask. False where
// that cannot be told.
bool isPaintedSilhouette(const std::string& path, const MendPlace& place, int figure) {
  const std::optional<SkeletonSource>& result = place.result;
  if (!result || ifThere(path).empty()) return false;
  if (result->mask) return fs::path(place.results).parent_path() / result->mask->file == fs::path(path);
  if (result->outline_sha256.empty() || result->number != figure) return false;
  try {
    const LookAtOutputs look;
    if (isAsSealed(readFile(path))) return false;
    const Plane8 grey = readMask(path);
    const Plane8 mask = (grey >= 128).select(Plane8::Constant(grey.rows(), grey.cols(), 255), grey * 0);
    Silhouette silhouette;
    silhouette.status = SilhouetteStatus::kFound;
    silhouette.outline = traceOutline(mask);
    return outlineHash(silhouette) != result->outline_sha256;
  } catch (const InputError&) {
    return false;
  }
}

// For this picture or the one before.
bool arePaintedLayers(const std::string& path, const MendPlace& place, int figure) {
  if ((!place.is_of_picture && !place.is_earlier) || place.result->number != figure || ifThere(path).empty())
    return false;
  const LookAtOutputs look;
  return !isAsSealed(readFile(path));
}

// What `file` names as the mask or the limbs that it was made with, if that is there and the same still.
template <class Source>
std::string namedBy(const std::string& file, const std::optional<Source>& source) {
  if (!source) return "";
  const fs::path named = fs::path(file).parent_path() / source->file;
  const std::string path =
      (source->file.find('/') == std::string::npos ? named : named.lexically_normal()).string();
  const LookAtOutputs look;
  return !ifThere(path).empty() && sha256(readFile(path)) == source->sha256 ? path : "";
}

bool isWrittenLater(const std::string& path, const std::string& other_path) {
  std::error_code unknown;
  return fs::last_write_time(path, unknown) > fs::last_write_time(other_path, unknown);
}

// What labels and result under the picture's own name name, wherever that lies.
void takeNamed(MendedFiles& files, const MendRequest& request, const std::string& own_skeleton,
               const std::optional<SkeletonSource>& own) {
  const bool finds_mask = request.mask.empty() && request.skeleton.empty();
  if (finds_mask && files.mask.empty() && !files.labels.empty() && areOfPicture(files.labels, request))
    files.mask = namedBy(files.labels, readLabelFile(files.labels).mask);
  if (!own || !request.isOfPicture(own->image_sha256)) return;
  if (finds_mask && files.mask.empty()) files.mask = namedBy(own_skeleton, own->mask);
  if (request.finds_limbs && files.limbs.empty()) files.limbs = namedBy(own_skeleton, own->limbs);
}

// What was made for the picture when it had another name, of each kind of which there is nothing under this
// one. What a run under this name, or labels of it, have taken up or left out since does not count.
void takeFormer(MendedFiles& files, const MendRequest& request, const std::vector<MendPlace>& places) {
  const bool first = request.figure == 1;
  const bool finds_mask = request.mask.empty() && request.skeleton.empty();
  const MendPlace* own =
      !places.empty() && places.front().is_own && places.front().is_of_picture ? &places.front() : nullptr;
  const std::string own_skeleton = own ? own->results + kSkeletonFileEnding : "";
  takeNamed(files, request, own_skeleton, own ? own->result : std::nullopt);
  const bool own_labels = !files.labels.empty() && !isBlankLabelFile(files.labels);
  for (const FormerPlace& former : formerPlaces(request, places)) {
    const MendPlace& place = former.place;
    if (place.is_beside && isAnnotated(request.source)) continue;
    const auto take = [&](std::string& taken, const std::string& path) {
      if (!taken.empty() || ifThere(path).empty()) return;
      taken = path;
      if (former.name != fs::path(request.source).filename()) files.former_name[path] = former.name;
    };
    if (request.finds_back && first) take(files.back, backIn(place));
    const std::string skeleton = place.results + kSkeletonFileEnding;
    const bool counts = place.result && !(own && isWrittenLater(own_skeleton, skeleton));
    const SkeletonSource result = counts ? *place.result : SkeletonSource();
    const std::string labels =
        own_labels || (own && !former.labels.empty() && isWrittenLater(own_skeleton, former.labels))
            ? ""
            : former.labels;
    if (request.skeleton.empty() && counts && hasEditedJoint(skeleton)) take(files.skeleton, skeleton);
    if (request.skeleton.empty() && first && !labels.empty() && !isBlankLabelFile(labels)) {
      if (!files.labels.empty() && isBlankLabelFile(files.labels)) files.labels.clear();
      take(files.labels, labels);
    }
    if (finds_mask && !own_labels) {
      if (first && !labels.empty()) take(files.mask, namedBy(labels, readLabelFile(labels).mask));
      if (counts) take(files.mask, namedBy(skeleton, result.mask));
      if (const std::string silhouette = place.results + ".silhouette.png";
          counts && isPaintedSilhouette(silhouette, place, request.figure))
        take(files.mask, silhouette);
    }
    if (request.finds_limbs) {
      if (const std::string made = madeOf(place, request.figure); !labels.empty() && !made.empty())
        take(files.limbs, made + ".limbs.png");
      if (counts) take(files.limbs, namedBy(skeleton, result.limbs));
      if (const std::string layers = place.results + ".layers.png";
          counts && arePaintedLayers(layers, place, request.figure))
        take(files.limbs, layers);
    }
  }
}

BodyPlans plansOf(const RigOptions& rig) {
  BodyPlans plans = {rig.body_plan};
  if (rig.otherwise) plans.push_back(rig.otherwise->body_plan);
  return plans;
}

// "": either. Joints that nobody has placed tell it as well.
std::string planOfLabels(const LabelFile& labels, const std::string& path, const RigOptions& rig) {
  const std::vector<std::string> names = jointNames(labels.joints);
  const BodyPlans plans = plansOf(rig);
  const SkeletonTemplate* plan = planWith(names, plans);
  if (const std::string unknown = unknownJointAmong(names, plans); !unknown.empty())
    throw InputError(path, unknown + "; mend its name, or name its template by --template");
  if (!plan)
    throw InputError(path, "has joints that are none of the template \"" + rig.body_plan.name +
                               "\"; name theirs by --template");
  return plan == &plans.back() || !planWith(names, {plans.back()}) ? plan->name : "";
}

using PlacesOfJoints = std::vector<std::pair<std::string, Eigen::Vector2d>>;

bool isThere(const PlacesOfJoints& joints, const std::string& name, const Eigen::Vector2d& place) {
  return std::any_of(joints.begin(), joints.end(), [&](const auto& joint) {
    return joint.first == name && isSamePlace(joint.second, place);
  });
}

// Of the joints that a person has placed in labels those that stand there in `joints`, too.
std::map<std::string, Eigen::Vector2d> placedThere(const LabelFile& labels, const PlacesOfJoints& joints) {
  std::map<std::string, Eigen::Vector2d> there;
  for (const auto& [name, place] : labels.joints)
    if (place && labels.isPlaced(name) && isThere(joints, name, *place)) there[name] = *place;
  return there;
}

// Leaves out joints that are in the skeleton because labels had them there, which those have no longer.
void takeBackJoints(PlacedJoints& placed, const LabelFile& labels) {
  const auto still = placedThere(labels, placed.joints);
  const std::size_t taken_back = std::erase_if(placed.joints, [&](const auto& joint) {
    const auto taken = placed.labels->joints.find(joint.first);
    return taken != placed.labels->joints.end() && isSamePlace(taken->second, joint.second) &&
           !still.contains(joint.first);
  });
  if (taken_back > 0) placed.skeleton.reset();
  if (placed.joints.empty()) placed.body_plan.clear();
}

// Those that a person has placed; of a file that was named also those that were found for it.
PlacedJoints jointsOfLabels(const std::string& path, bool named, const std::string& source,
                            const std::string& image_sha256, const RigOptions& rig) {
  const LabelFile file = readLabelFile(path);
  PlacedJoints placed;
  for (const auto& [name, place] : file.joints)
    if (place && (named || file.isPlaced(name))) placed.joints.emplace_back(name, *place);
  if (named && placed.joints.empty())
    throw InputError(path, "holds no joints, only classes of candidates; place them (" +
                               toolCommand("skel-label") + " " + shellWord(source) +
                               ", key J), or name a .skeleton.json");
  if (named && file.image.sha256 != image_sha256)
    throw InputError(path, "was made for another picture than " + source + "; place the joints anew (" +
                               toolCommand("skel-label") + " " + shellWord(source) + ")");
  // A person may have chosen it, and placed nothing.
  const bool may_tell_plan =
      rig.otherwise && !file.joints.empty() && planWith(jointNames(file.joints), plansOf(rig));
  if (!placed.joints.empty() || may_tell_plan) placed.body_plan = planOfLabels(file, path, rig);
  return placed;
}

}  // namespace

MendedFiles mendedFiles(const MendRequest& request) {
  MendedFiles files;
  files.mask = request.mask;
  if (isLabelFile(request.skeleton)) files.labels = request.skeleton;
  files.limbs = request.limbs;
  files.back = request.back;
  if (!request.takes_up) return files;

  const bool first = request.figure == 1;
  const bool annotated = isAnnotated(request.source);
  const bool no_skeleton = request.skeleton.empty(), no_mask = request.mask.empty();
  const std::vector<MendPlace> places = mendPlaces(request);
  std::string painted, painted_layers;
  for (const MendPlace& place : places) {
    if (place.is_earlier && !files.earlier_result) files.earlier_result = place.result;
    const bool made = place.is_beside ? !annotated : place.is_of_picture;
    const std::string made_of = madeOf(place, request.figure);
    if (made && no_mask && no_skeleton && !made_of.empty())
      offer(files.mask, made_of + ".mask.png", sameBytes, files);
    if (made && request.finds_limbs && request.limbs.empty() && !made_of.empty())
      offer(files.limbs, made_of + ".limbs.png", sameBytes, files);
    if (made && request.finds_back && request.back.empty() && first)
      offer(files.back, backIn(place), sameBytes, files);
    const std::string labels = place.made + kLabelFileEnding;
    if (no_skeleton && first && !(place.is_beside && annotated) &&
        (place.is_beside || areOfPicture(labels, request)))
      offer(files.labels, labels, sameBytes, files);
    if (place.results.empty() || (place.is_beside && annotated && !place.is_own)) continue;
    if (const std::string skeleton = place.results + kSkeletonFileEnding;
        no_skeleton && (hasEditedJoint(skeleton) || hasUnknownJoint(skeleton)))
      offerResult(files.skeleton, skeleton, place, haveSameJoints, files);
    if (const std::string silhouette = place.results + ".silhouette.png";
        no_skeleton && no_mask && isPaintedSilhouette(silhouette, place, request.figure))
      offerResult(painted, silhouette, place, sameBytes, files);
    if (const std::string layers = place.results + ".layers.png";
        request.finds_limbs && request.limbs.empty() && arePaintedLayers(layers, place, request.figure))
      offerResult(painted_layers, layers, place, sameBytes, files);
  }
  const std::optional<SkeletonSource> result = resultAmong(places);
  files.has_result = result.has_value();
  for (const MendPlace& place : places)
    if (no_skeleton && files.facing.empty() && place.is_of_picture && place.result &&
        place.result->number == request.figure && place.result->facing_deg)
      files.facing = place.results + kSkeletonFileEnding, files.facing_deg = *place.result->facing_deg;
  leaveOutEarlier(files, request, result);
  if (!painted.empty()) {
    files.painted_silhouette = files.mask.empty();
    offer(files.mask, painted, sameBytes, files);
  }
  if (!painted_layers.empty()) {
    files.painted_layers = files.limbs.empty();
    offer(files.limbs, painted_layers, sameBytes, files);
  }
  takeFormer(files, request, places);
  if (no_skeleton && files.skeleton.empty()) files.fits_again = earlierThatFits(places, request);
  if (request.finds_limbs && files.limbs.empty() && (files.earlier_result || !files.fits_again.empty()))
    files.kept_layers = earlierLayers(places);
  return files;
}

PlacedJoints placedJoints(const MendedFiles& files, const MendRequest& request, const RigOptions& rig,
                          const Image& image) {
  PlacedJoints placed;
  if (!files.skeleton.empty()) {
    const LookAtOutputs look;
    const std::string text = readFile(files.skeleton);
    const SkeletonFile file =
        parseSkeletonFile(text, files.skeleton, planOfSkeleton(text, files.skeleton, rig));
    if (file.image_width != image.width || file.image_height != image.height)
      throw InputError(files.skeleton, "was mended for a picture of another size than " + request.source +
                                           " has; move it elsewhere, or lose it by --force");
    if (file.figure.number != request.figure)
      throw InputError(files.skeleton,
                       "holds joints of figure " + std::to_string(file.figure.number) +
                           " that were moved by hand, figure " + std::to_string(request.figure) +
                           " is to be rigged; name another folder by -o, or lose them by --force");
    for (const Joint& joint : file.skeleton.joints)
      if (joint.origin == JointOrigin::kEdited) placed.joints.emplace_back(joint.name, joint.image);
    placed.body_plan = file.skeleton.template_name;
    placed.labels = file.labels;
    placed.outline_sha256 = file.figure.sha256;
    placed.skeleton = file;
  }
  if (files.labels.empty()) return placed;
  const std::string labels_sha256 = sha256(readFile(files.labels));
  if (placed.labels && placed.labels->sha256 == labels_sha256) {
    const LabelFile labels = readLabelFile(files.labels);
    placed.labels = SkeletonFile::Labels{files.labels, labels_sha256, placedThere(labels, placed.joints)};
    placed.of_own_labels = placed.labels->joints.size();
    return placed;
  }
  if (placed.labels) takeBackJoints(placed, readLabelFile(files.labels));
  const PlacedJoints labelled = jointsOfLabels(files.labels, files.labels == request.skeleton, request.source,
                                               request.image_sha256, rig);
  if (labelled.joints.empty()) {
    placed.labels.reset();
    if (placed.joints.empty()) placed.body_plan = labelled.body_plan;
    placed.has_plan_of_labels =
        placed.joints.empty() && !labelled.body_plan.empty() && labelled.body_plan != rig.body_plan.name;
    return placed;
  }
  placed.labels_count = !files.skeleton.empty() && !isWrittenLater(files.skeleton, files.labels);
  if (!labelled.body_plan.empty() && labelled.body_plan != placed.body_plan) {
    if (!placed.joints.empty() && !placed.labels_count) {
      for (const auto& joint : labelled.joints) placed.contradicted.push_back(joint.first);
      placed.labels = SkeletonFile::Labels{files.labels, labels_sha256, {}};
      return placed;
    }
    for (const auto& joint : placed.joints) placed.contradicted.push_back(joint.first);
    placed.joints.clear();
    placed.body_plan = labelled.body_plan;
  }
  for (const auto& joint : labelled.joints) {
    const auto there = std::find_if(placed.joints.begin(), placed.joints.end(),
                                    [&](const auto& other) { return other.first == joint.first; });
    const bool is_new = there == placed.joints.end();
    const bool contradicts = !is_new && !isSamePlace(there->second, joint.second);
    if (contradicts) placed.contradicted.push_back(joint.first);
    if (is_new)
      placed.joints.push_back(joint);
    else if (!contradicts || placed.labels_count)
      there->second = joint.second;
    placed.has_of_labels |= is_new || (contradicts && placed.labels_count);
  }
  if (placed.has_of_labels) placed.skeleton.reset();
  placed.labels = SkeletonFile::Labels{files.labels, labels_sha256, {}};
  for (const auto& [name, place] : labelled.joints)
    if (isThere(placed.joints, name, place)) placed.labels->joints[name] = place;
  placed.of_own_labels = placed.labels->joints.size();
  return placed;
}

void leaveOutOtherFigures(MendedFiles& files, const MendRequest& request, const Image& image,
                          FigureFinder& figures) {
  if (!request.is_one_of_all || request.figure > 1 || files.mask.empty() || files.mask == request.mask)
    return;
  const LookAtOutputs look;
  const Plane8 mask = readMask(files.mask);
  const Silhouette first = figures.take(image, 1);
  if (!first.found() || mask.rows() != first.mask.rows() || mask.cols() != first.mask.cols() ||
      (mask >= 128 && first.mask != 0).any())
    return;
  files.painted_silhouette = false;
  files.other_figure.push_back(std::exchange(files.mask, ""));
  if (!files.labels.empty()) files.other_figure.push_back(std::exchange(files.labels, ""));
}

std::optional<Note> otherFigureNote(const MendedFiles& files) {
  if (files.other_figure.empty()) return std::nullopt;
  const std::string shared = "made for another figure than the largest, not taken up with --figure all";
  return Note{shared + ": " + joined(files.other_figure), shared, joined(files.other_figure)};
}

void leaveOutOtherPlans(MendedFiles& files, const MendRequest& request, const RigOptions& rig) {
  const BodyPlans plans = plansOf(rig);
  if (!files.skeleton.empty()) {
    const LookAtOutputs look;
    const std::string plan = templateOfSkeleton(readFile(files.skeleton), files.skeleton);
    const bool is_asked_for = findPlan(plan, plans) != nullptr;
    if (!is_asked_for && files.skeleton == request.results + kSkeletonFileEnding)
      throw InputError(files.skeleton, "holds joints of a " + plan + " that were moved by hand, a " +
                                           rig.body_plan.name + "'s are asked for; give --template " + plan +
                                           ", name another folder by -o, or lose them by --force");
    if (!is_asked_for) {
      files.other_plan.push_back(std::exchange(files.skeleton, ""));
      files.other_plan_name = plan;
    }
  }
  if (files.labels.empty() || files.labels == request.skeleton) return;
  const LabelFile labels = readLabelFile(files.labels);
  const std::vector<std::string> names = jointNames(labels.joints);
  if (!labels.hasPlacedJoint() || planWith(names, plans)) return;
  if (const std::string unknown = unknownJointAmong(names, plans); !unknown.empty()) {
    files.unknown_joint = std::exchange(files.labels, "") + ": " + unknown;
    return;
  }
  files.other_plan_name = otherPlanWith(names, plans);
  files.other_plan.push_back(std::exchange(files.labels, ""));
}

std::optional<Note> otherPlanNote(const MendedFiles& files, const RigOptions& rig) {
  if (files.other_plan.empty()) return std::nullopt;
  const std::string& theirs = files.other_plan_name;
  const std::string shared =
      theirs.empty() ? "joints placed by hand of another body plan than \"" + rig.body_plan.name +
                           "\" are left out (name theirs by --template)"
                     : "joints placed by hand are a " + theirs + "'s, a " + rig.body_plan.name +
                           "'s are asked for: left out (--template " + theirs + ", or auto, takes them up)";
  return Note{shared + ": " + joined(files.other_plan), shared, joined(files.other_plan)};
}

std::optional<Note> unknownJointNote(const MendedFiles& files) {
  if (files.unknown_joint.empty()) return std::nullopt;
  const std::string shared =
      "joints placed by hand are left out, as one is of no body plan (mend its name, or name its template by "
      "--template)";
  return Note{shared + ": " + files.unknown_joint, shared, files.unknown_joint};
}

RigOptions forBodyPlan(const RigOptions& rig, const std::string& body_plan) {
  RigOptions one = rig;
  if (body_plan.empty() || !rig.otherwise) return one;
  if (body_plan == rig.otherwise->body_plan.name) {
    one.body_plan = rig.otherwise->body_plan;
    one.clips = rig.otherwise->clips;
  }
  one.otherwise.reset();
  return one;
}

std::optional<Note> contradictionNote(const MendedFiles& files, const PlacedJoints& placed,
                                      const std::string& kept) {
  if (placed.contradicted.empty()) return std::nullopt;
  std::string loses = files.skeleton, counts = files.labels;
  if (!placed.labels_count) std::swap(loses, counts);
  const std::string shared = "joints that two files place elsewhere, by hand: the one written later counts",
                    what = counts + ", not " + loses + (kept.empty() ? "" : " (now " + kept + ")") + ": " +
                           joined(placed.contradicted);
  return Note{shared + ": " + what, shared, what};
}

std::optional<Note> mendedNote(const MendedFiles& files, const MendRequest& request,
                               const PlacedJoints& placed) {
  std::vector<std::string> what;
  // "limbs (boy.limbs.png)"
  const auto add = [&](const std::string& name, const std::vector<std::string>& from) {
    std::string text = name + " (" + joined(from);
    for (const std::string& file : from)
      if (const auto former = files.former_name.find(file); former != files.former_name.end())
        text += ", made when the picture was called " + former->second;
    for (const MendedFiles::PassedOver& other : files.passed_over)
      if (std::find(from.begin(), from.end(), other.for_file) != from.end())
        text += "; not " + other.file + ", which differs";
    what.push_back(text + ")");
  };
  const auto addFound = [&](const std::string& name, const std::string& file, const std::string& named) {
    if (!file.empty() && file != named) add(name, {file});
  };
  if (const std::size_t count = placed.joints.size(); count > 0 && request.skeleton.empty()) {
    std::vector<std::string> from;
    if (!files.skeleton.empty() && placed.of_own_labels < count) from.push_back(files.skeleton);
    if (placed.has_of_labels || placed.of_own_labels > 0) from.push_back(files.labels);
    add(std::to_string(count) + (count == 1 ? " joint" : " joints"), from);
  }
  if (placed.has_plan_of_labels) add("the body plan " + placed.body_plan, {files.labels});
  addFound(files.painted_silhouette ? "silhouette" : "mask", files.mask, request.mask);
  addFound("limbs", files.limbs, request.limbs);
  addFound("back", files.back, request.back);
  addFound("which way it looks", files.facing, "");
  if (what.empty()) return std::nullopt;
  const std::string shared = "made by hand and taken up";
  return Note{shared + ": " + joined(what), shared, joined(what)};
}

}  // namespace skel
