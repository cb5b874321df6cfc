#include "libskel/mended/rig_mended.h"

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <utility>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/sha256.h"
#include "libskel/image/check_image.h"
#include "libskel/image/read_image.h"
#include "libskel/labels/label_file.h"
#include "libskel/mended/earlier_picture.h"
#include "libskel/mended/mend_places.h"
#include "libskel/pipeline/rig_drawing.h"
#include "libskel/recognition/joint_note.h"
#include "libskel/silhouette/outline.h"
#include "libskel/skeleton/outside_figure.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

// Reads the mask that is used and returns its path and hash, "": none. A skeleton that was handed in brings
// its own.
SkeletonFile::Mask useMask(const MendRequest& request, const MendedFiles& mended,
                           const std::optional<SkeletonFile>& given, RigInput& input) {
  std::optional<LookAtOutputs> look;  // a result that was painted in place, of this name or another
  if (mended.mask != request.mask) look.emplace();
  std::string path = mended.mask;
  if (path.empty() && given && given->mask) {
    path = (fs::path(request.skeleton).parent_path() / given->mask->file).string();
    if (sha256(readFile(path)) != given->mask->sha256)
      throw InputError(path, "has changed since " + request.skeleton +
                                 " was made with it; name it by --mask of skel-infer if that is meant");
  }
  if (path.empty()) return {};
  input.mask = readMask(path);
  if (input.mask->cols() != input.image.width || input.mask->rows() != input.image.height)
    throw InputError(path, "is a mask of " + sizeInPx(input.mask->cols(), input.mask->rows()) +
                               " px, the image has " + sizeInPx(input.image.width, input.image.height));
  return {path, sha256(readFile(path)), mended.mask_before};
}

// Which figure of the mask is the picture's of that number: one that was found for it, or shows fewer
// figures, shows it alone.
int figureOfMask(const std::string& mask, const MendRequest& request, const MendedFiles& mended,
                 const RigInput& input) {
  if (request.figure <= 1) return 1;
  const bool is_own = mask.ends_with(stemOfFigure("", request.figure) + ".mask.png") ||
                      (!mended.mask.empty() && mended.mask != request.mask);
  return is_own || silhouetteFromMask(*input.mask, input.image).figure_count < request.figure
             ? 1
             : request.figure;
}

// Of the outline that the picture alone gives, "": none.
std::string foundOutline(FigureFinder& figures, const Image& image, int figure) {
  const Silhouette silhouette = figures.take(image, figure);
  return silhouette.found() ? outlineHash(silhouette) : "";
}

// The request as it is where an earlier picture of this size shows the very same figure in other colours.
MendRequest knowingRecolored(MendRequest request, const SkeletonSource& earlier, const Image& image,
                             FigureFinder& figures) {
  if (earlier.number == request.figure && !earlier.found_outline_sha256.empty() &&
      earlier.image_width == image.width && earlier.image_height == image.height &&
      earlier.found_outline_sha256 == foundOutline(figures, image, request.figure))
    request.recolored_sha256 = earlier.image_sha256;
  return request;
}

// The joints must be this figure's. `file`: where they are from.
void checkJoints(const Skeleton& skeleton, const std::string& file, int figure, const Plane8& mask) {
  const Joint* stray = jointFarOutside(skeleton, mask);
  if (!stray) return;
  throw InputError(file,
                   "joint \"" + stray->name + "\" lies far outside figure " + std::to_string(figure) +
                       " of the drawing; place it on the figure, or take the skeleton of this one; where the "
                       "figure lacks a part, mend its mask (skel-label, key M)");
}

constexpr const char* kOutlineChanged =
    "the figure is not outlined as it was when the joints were found: look at them";

// The limb on the other side if no pixel is painted as that; "": there is none, or it is painted.
std::string unpaintedMirror(const RiggedDrawing& drawing, int limb) {
  for (const auto& [one, other] : drawing.body_plan.limbPairs())
    for (const auto& [painted, mirror] : {std::pair(one + 1, other + 1), std::pair(other + 1, one + 1)})
      if (painted == limb && !drawing.layers.has(mirror)) return limbName(drawing.body_plan, mirror);
  return "";
}

// Of limbs that were painted in pieces, maybe both arms in one colour.
std::vector<std::string> looseLimbs(const RiggedDrawing& drawing) {
  constexpr double kSpecks = .02;  // of the limb: less is the brush's
  constexpr double kAnother = .25;
  std::vector<std::string> warnings;
  for (int limb = 1; limb <= int(drawing.body_plan.limbs.size()); ++limb) {
    const int loose = loosePixels(drawing.layers, limb, drawing.found_limbs);
    const auto all = double((drawing.layers.limb == limb).count());
    if (loose == 0 || loose < kSpecks * all) continue;
    const std::string mirror = loose > kAnother * all ? unpaintedMirror(drawing, limb) : "";
    warnings.push_back(std::to_string(loose) + " px painted as the " + limbName(drawing.body_plan, limb) +
                       " are not joined to the rest of it and stay with the body" +
                       (mirror.empty() ? "" : ", and none are painted as the " + mirror) +
                       ": look at them (skel-label FILE, key G)");
  }
  return warnings;
}

// What to say of a figure whose joints were given.
std::vector<std::string> warningsOf(const SkeletonFile& given, const RiggedDrawing& drawing, bool own_mask) {
  std::vector<std::string> warnings = drawing.silhouette.warnings;
  // What was said of joints before somebody moved them is stale, but for what is still missing.
  std::vector<std::string> of_joints = given.warnings;
  if (hasPlacedJoint(given.skeleton)) of_joints = {missingNote(given.missing)};
  for (const std::string& warning : of_joints)
    if (!warning.empty() && std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
      warnings.push_back(warning);
  if (!own_mask && !given.figure.sha256.empty() && given.figure.sha256 != outlineHash(drawing.silhouette))
    warnings.push_back(kOutlineChanged);
  return warnings;
}

}  // namespace

bool hasPlacedJoint(const Skeleton& skeleton) {
  return std::any_of(skeleton.joints.begin(), skeleton.joints.end(),
                     [](const Joint& joint) { return joint.origin == JointOrigin::kEdited; });
}

std::optional<SkeletonFile> givenSkeleton(const std::string& path, const RigOptions& rig) {
  if (path.empty() || path.ends_with(kLabelFileEnding)) return std::nullopt;
  const std::string text = readFile(path);
  return parseSkeletonFile(text, path, planOfSkeleton(text, path, rig));
}

int figureOf(const SkeletonFile& given, const std::string& path, int asked) {
  if (asked != 1 && asked != given.figure.number)
    throw InputError(path, "belongs to figure " + std::to_string(given.figure.number) +
                               " of the drawing, --figure asks for " + std::to_string(asked));
  return given.figure.number;
}

MendedRig rigMended(const MendRequest& request, const RigOptions& rig, RigInput input,
                    const std::optional<SkeletonFile>& given) {
  if (given) {
    if (given->image_width != input.image.width || given->image_height != input.image.height)
      throw InputError(request.skeleton, "belongs to an image of " +
                                             sizeInPx(given->image_width, given->image_height) + " px, " +
                                             request.source + " has " +
                                             sizeInPx(input.image.width, input.image.height));
    input.skeleton = given->skeleton;
    input.turned_deg = given->figure.turned_deg;
  }
  input.file = request.source;
  SilhouetteOptions silhouette = rig.silhouette;
  silhouette.figure = std::max(request.figure, 1);
  silhouette.all = request.is_one_of_all;
  FigureFinder own_figures(silhouette);
  FigureFinder& figures = input.figures ? *input.figures : own_figures;
  MendedRig result;
  MendedFiles& mended = result.files;
  mended = mendedFiles(request);
  if (mended.earlier_result) {
    input.figures = &figures;  // looked at once
    mended = mendedFiles(knowingRecolored(request, *mended.earlier_result, input.image, figures));
  }
  leaveOutOtherSizes(mended, request, input.image);
  leaveOutOtherFigures(mended, request, input.image, figures);
  leaveOutOtherPlans(mended, request, rig);
  PlacedJoints& placed = result.placed;
  placed = placedJoints(mended, request, rig, input.image);
  if (placed.skeleton) {
    input.skeleton = placed.skeleton->skeleton;
    input.turned_deg = placed.skeleton->figure.turned_deg;
  } else {
    input.placed = placed.joints;
  }
  result.mask = useMask(request, mended, given, input);
  const std::string& mask = result.mask.file;
  if (!mask.empty() && !request.results.empty())
    result.found_outline_sha256 = foundOutline(figures, input.image, silhouette.figure);
  if (!mended.limbs.empty()) {
    std::optional<LookAtOutputs> look;
    if (mended.limbs != request.limbs) look.emplace();
    input.layers = {readImage(mended.limbs), mended.limbs};
    if (!mended.painted_layers && mended.limbs != request.limbs)
      result.limbs = {mended.limbs, sha256(readFile(mended.limbs)), mended.limbs_before};
  }
  if (!mended.back.empty()) input.back = {readImage(mended.back), mended.back};

  RigOptions figure_rig = forBodyPlan(rig, placed.body_plan);
  figure_rig.silhouette = silhouette;
  if (rig.facing_rad) {
    result.facing_deg = *rig.facing_rad * 180 / std::numbers::pi;
    mended.facing.clear();
  } else if (given) {
    result.facing_deg = given->figure.facing_deg;
  } else if (!mended.facing.empty()) {
    result.facing_deg = mended.facing_deg;
  }
  if (result.facing_deg) figure_rig.facing_rad = *result.facing_deg * std::numbers::pi / 180;
  if (!mask.empty()) figure_rig.silhouette.figure = figureOfMask(mask, request, mended, input);
  if (given || !placed.joints.empty()) figure_rig.last = std::max(figure_rig.last, LastStage::kJoints);
  result.last = figure_rig.last;
  RiggedDrawing& drawing = result.drawing;
  drawing = rigCharacter(std::move(input), figure_rig);
  if (!drawing.found() && !mask.empty()) throw InputError(mask, drawing.silhouette.reason);
  if (!drawing.found()) throw NoFigureError(request.source, drawing.silhouette.reason);
  if (given) checkJoints(given->skeleton, request.skeleton, request.figure, drawing.silhouette.mask);
  if (const auto& as_it_stands = given ? given : placed.skeleton) {
    drawing.recognition.confidence = as_it_stands->confidence;
    drawing.recognition.missing = as_it_stands->missing;
    result.warnings = warningsOf(*as_it_stands, drawing, !mask.empty());
  } else {
    result.warnings = figureNotes(drawing);
  }
  result.outline_sha256 = outlineHash(drawing.silhouette);
  if (!placed.joints.empty()) {
    checkJoints(drawing.recognition.skeleton, mended.skeleton.empty() ? mended.labels : mended.skeleton,
                request.figure, drawing.silhouette.mask);
    if (!placed.skeleton && mask.empty() && !placed.outline_sha256.empty() &&
        placed.outline_sha256 != result.outline_sha256)
      result.warnings.push_back(kOutlineChanged);
  }
  if (!mended.limbs.empty())
    for (std::string& warning : looseLimbs(drawing)) result.warnings.push_back(std::move(warning));
  for (std::string& warning : partlyDrawnNotes(drawing))
    if (std::find(result.warnings.begin(), result.warnings.end(), warning) == result.warnings.end())
      result.warnings.push_back(std::move(warning));
  for (const char* warning : warningsOfEarlier(mended)) result.warnings.emplace_back(warning);
  return result;
}

std::vector<Note> mendedNotes(const MendedRig& rig, const MendRequest& request, const RigOptions& options) {
  std::vector<Note> notes;
  for (const auto& note :
       {mendedNote(rig.files, request, rig.placed), contradictionNote(rig.files, rig.placed),
        otherPlanNote(rig.files, options), unknownJointNote(rig.files), earlierNote(rig.files),
        otherSizeNote(rig.files), fitsAgainNote(rig.files), keptLayersNote(rig.files, request)})
    if (note) notes.push_back(*note);
  return notes;
}

}  // namespace skel
