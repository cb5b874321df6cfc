#include "labeler/import_labels.h"

#include <algorithm>
#include <filesystem>

#include "labeler/annotated_drawing.h"
#include "labeler/drawing_list.h"
#include "labeler/joints_outside_mask.h"
#include "labeler/placed_joints.h"
#include "libskel/core/caught_error.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/progress.h"
#include "libskel/core/sha256.h"
#include "libskel/image/check_image.h"
#include "libskel/image/read_image.h"
#include "libskel/image/write_image.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/labels/label_file.h"
#include "libskel/labels/label_folder.h"
#include "libskel/mended/former_names.h"
#include "libskel/skeleton/skeleton_file.h"

namespace skel {
namespace {

namespace fs = std::filesystem;

std::string peek(const std::string& path) {
  const LookAtOutputs look;
  return readFile(path);
}

// `file` in the output folder, where there is one.
std::string destination(const std::string& file, const std::string& dir, const ImportOptions& options) {
  if (options.output.empty()) return file;
  const fs::path below =
      fs::path(file).lexically_normal().lexically_relative(fs::path(dir).lexically_normal());
  if (below.empty() || *below.begin() == "..")
    throw InputError(file, "lies outside " + dir + "; import it from there, or leave out -o");
  return (fs::path(options.output) / below).string();
}

// What is there already may be somebody's work.
void writeNew(const std::string& path, const std::string& bytes, const ImportOptions& options) {
  const bool there = fs::symlink_status(path).type() != fs::file_type::not_found;
  if (there && fs::exists(path) && peek(path) == bytes) return;
  if (there && !options.force)
    throw InputError(path, "is there already, with other content; take it away, or give --force to lose it");
  writeFile(path, bytes);
}

void copyFile(const std::string& from, const std::string& to, const ImportOptions& options) {
  if (from != to) writeNew(to, readFile(from), options);
}

void checkJoints(const AnnotatedDrawing& drawing, const Image& image) {
  for (const auto& [name, place] : drawing.joints)
    if (place && !isInPicture(*place, image))
      throw InputError(drawing.source, "joint " + name + " lies outside " + drawing.image);
}

// Somebody may have scaled it, or put a border around it.
void checkSize(const AnnotatedDrawing& drawing, const Image& image) {
  if (drawing.image_width == 0 ||
      (drawing.image_width == image.width && drawing.image_height == image.height))
    return;
  throw InputError(drawing.image, "is " + sizeInPx(image.width, image.height) + " px, " +
                                      fs::path(drawing.source).filename().string() + " says " +
                                      sizeInPx(drawing.image_width, drawing.image_height) +
                                      ": its joints and outline are of another picture");
}

std::string namesOf(const BodyPlans& plans) {
  std::string names;
  for (const SkeletonTemplate& plan : plans) names += (names.empty() ? "" : " or ") + plan.name;
  return names;
}

void countMissing(const std::string& label_path, const LabelFile& labels, const SkeletonTemplate& body_plan,
                  ImportCounts& counts) {
  const auto has = [&](const std::string& name) {
    return std::any_of(labels.joints.begin(), labels.joints.end(),
                       [&](const auto& joint) { return joint.first == name && joint.second; });
  };
  bool lacks = false;
  for (const TemplateJoint& joint : body_plan.joints)
    if (!joint.derived && !has(joint.name)) lacks = true, counts.missing_joints.insert(joint.name);
  if (!lacks) return;
  counts.lacking.push_back(label_path);
  counts.without_class +=
      static_cast<std::size_t>(std::count(labels.labels.begin(), labels.labels.end(), std::nullopt));
}

void countJoints(const LabelFile& labels, const SkeletonTemplate& body_plan, ImportCounts& counts) {
  for (const auto& [name, place] : labels.joints) {
    const int joint = body_plan.find(name);
    if (labels.isPlaced(name))
      ++counts.joints_placed;
    else if (place && joint >= 0 && !body_plan.joints[static_cast<size_t>(joint)].derived)
      ++counts.joints_found;
  }
}

bool areSame(const std::optional<Eigen::Vector2d>& a, const std::optional<Eigen::Vector2d>& b) {
  return a && b ? isSamePlace(*a, *b) : !a && !b;
}

// Whether the label file has other joints than the annotation, or they are somebody else's: placed by a
// person, or found. Those that follow from others do not count.
bool jointsDiffer(const LabelFile& labels, const AnnotatedDrawing& drawing,
                  const SkeletonTemplate& body_plan) {
  const auto contains = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const auto same = [&](const auto& joint) {
    const auto ours = std::find_if(labels.joints.begin(), labels.joints.end(),
                                   [&](const auto& other) { return other.first == joint.first; });
    const bool found = contains(drawing.recognized, joint.first);
    if (ours == labels.joints.end() || found != contains(labels.recognized, joint.first)) return false;
    const int j = body_plan.find(joint.first);
    const bool follows = found && j >= 0 && body_plan.joints[static_cast<size_t>(j)].derived;
    return follows || areSame(ours->second, joint.second);
  };
  return !std::all_of(drawing.joints.begin(), drawing.joints.end(), same);
}

// Whether the mask that the labels were made by is not what it was, beside them or where it is imported from;
// or one lies there that they do not name.
bool maskHasChanged(const std::string& label_path, const LabelFile& labels, const AnnotatedDrawing& drawing) {
  if (!labels.mask) return drawing.mask_polygons.empty() && maskBeside(drawing.image).has_value();
  const auto isOther = [&](const std::string& path) {
    return fs::exists(path) && sha256(readFile(path)) != labels.mask->sha256;
  };
  const std::string ours = besideLabelFile(label_path, labels.mask->file);
  return !fs::exists(ours) || isOther(ours) || isOther(besideFile(drawing.image, labels.mask->file));
}

// A label file that cannot be read is not compared.
void compareKept(const std::string& label_path, const AnnotatedDrawing& drawing,
                 const SkeletonTemplate& body_plan, ImportCounts& counts) {
  try {
    const LabelFile labels = readLabelFile(label_path);
    if (labels.image.sha256 != sha256(readFile(drawing.image))) {
      counts.earlier.push_back(label_path);
      return;
    }
    if (maskHasChanged(label_path, labels, drawing)) counts.other_mask.push_back(label_path);
    if (jointsDiffer(labels, drawing, body_plan)) counts.differing.push_back(label_path);
  } catch (const InputError&) {
  }
}

// What is to be made anew, if it is a label file of this very picture. One that cannot be read is refused: it
// may hold classes that were set by hand.
std::optional<LabelFile> labelsBefore(const std::string& label_path, const std::string& image_path) {
  if (!fs::exists(label_path)) return std::nullopt;
  const LookAtOutputs look;
  LabelFile labels = readLabelFile(label_path);
  return labels.image.sha256 == sha256(peek(image_path)) ? std::optional(std::move(labels)) : std::nullopt;
}

// Takes over the classes of `before` that its own joints do not explain, also that there is none among
// others, for candidates that are still there; returns how many.
int keepClasses(LabelFile& labels, const LabelFile& before, const LabelFile& by_joints_before) {
  int kept = 0;
  const auto open = std::count(before.labels.begin(), before.labels.end(), std::nullopt);
  const bool labelled = 2 * open < std::ptrdiff_t(before.labels.size());  // else the rest is to come
  for (std::size_t i = 0; i < labels.candidates.size(); ++i) {
    const JointCandidate& at = labels.candidates[i];
    const auto same = std::find_if(
        before.candidates.begin(), before.candidates.end(),
        [&](const auto& other) { return other.x == at.x && other.y == at.y && other.radius == at.radius; });
    if (same == before.candidates.end()) continue;
    const auto& label = before.labels[std::size_t(same - before.candidates.begin())];
    if ((!label && !labelled) || label == by_joints_before.labels[i] || label == labels.labels[i]) continue;
    labels.labels[i] = label;
    ++kept;
  }
  return kept;
}

// Classes of candidates of `before` that are gone, where the nearest one that is there has another.
int droppedClasses(const LabelFile& labels, const LabelFile& before) {
  int dropped = 0;
  for (std::size_t i = 0; i < before.candidates.size(); ++i) {
    const JointCandidate& at = before.candidates[i];
    const auto distance = [&](const JointCandidate& other) {
      return std::hypot(other.x - at.x, other.y - at.y) + std::abs(other.radius - at.radius);
    };
    const auto nearest =
        std::min_element(labels.candidates.begin(), labels.candidates.end(),
                         [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    if (!before.labels[i] || nearest == labels.candidates.end() || distance(*nearest) == 0) continue;
    dropped += before.labels[i] != labels.labels[std::size_t(nearest - labels.candidates.begin())];
  }
  return dropped;
}

// What the labels say that can hardly be of this figure.
void countOutside(const std::string& label_path, const LabelFile& labels,
                  const std::optional<std::string>& mask, const Silhouette& figure,
                  const SkeletonTemplate& body_plan, ImportCounts& counts) {
  std::string outside = mask ? jointsOutsideMask(labels, body_plan, *mask) : "";
  if (outside.empty()) outside = jointFarOutsideFigure(labels, figure.mask);
  if (!outside.empty()) counts.outside_mask.push_back(label_path + ": " + outside);
  if (const auto limb = classWithoutCandidate(labels, body_plan))
    counts.without_limb[*limb].push_back(label_path);
}

// Whether a label file was made.
bool importDrawing(const AnnotatedDrawing& drawing, const std::string& dir, const BodyPlans& plans,
                   const ImportOptions& options, ImportCounts& counts) {
  const SkeletonTemplate& body_plan = planOf(drawing.joints, plans);
  const std::string image_path = destination(drawing.image, dir, options);
  const std::string label_path = labelFileFor(image_path);
  if (!options.force && fs::exists(label_path)) {
    compareKept(label_path, drawing, body_plan, counts);
    return false;
  }

  const std::optional<LabelFile> before = labelsBefore(label_path, drawing.image);
  const Image image = readImage(drawing.image);
  checkSize(drawing, image);
  checkJoints(drawing, image);
  std::optional<std::string> mask = drawing.mask;
  if (!mask && drawing.mask_polygons.empty()) mask = maskBeside(drawing.image);
  if (mask) readMaskOf(image, *mask);  // before anything is copied
  copyFile(drawing.image, image_path, options);
  if (mask) {
    const std::string from = *mask;
    mask = destination(from, dir, options);
    copyFile(from, *mask, options);
  } else if (!drawing.mask_polygons.empty()) {
    mask = drawingFiles(image_path, {}).mask;
    writeNew(*mask, encodePng(maskFromPolygons(drawing.mask_polygons, image.width, image.height)), options);
  }
  const Silhouette figure = silhouetteOf(image_path, mask);
  LabelFile labels = labelFigure(figure, image_path, mask, drawing.joints, body_plan, {}, drawing.recognized);
  if (before) {
    counts.classes_kept += keepClasses(labels, *before,
                                       labelFigure(figure, image_path, mask, before->joints,
                                                   planOf(before->joints, plans), {}, before->recognized));
    counts.classes_dropped += droppedClasses(labels, *before);
  }
  writeLabelFile(label_path, labels);
  countJoints(labels, body_plan, counts);
  countMissing(label_path, labels, body_plan, counts);
  countOutside(label_path, labels, mask, figure, body_plan, counts);
  const std::string folder = fs::path(label_path).lexically_normal().parent_path().string();
  counts.folders.insert(folder.empty() ? "." : folder);
  return true;
}

// Beside its picture.
std::string labelFileOf(const AnnotatedDrawing& drawing) {
  return fs::path(labelFileFor(drawing.image)).lexically_normal().string();
}

void countFailure(const Error& error, ImportCounts& counts, const OnError& on_error) {
  if (counts.failed++ == 0) counts.exit_code = error.exitCode();
  on_error(error);
}

// Runs `make` for each; it says whether a label file was made, and may count what is in it.
template <class List, class Make>
void forEach(const List& list, const char* title, const OnError& on_error, const Make& make,
             ImportCounts& counts) {
  ProgressBar bar(title, list.size());
  for (const auto& entry : list) {
    try {
      make(entry) ? ++counts.made : ++counts.kept;
    } catch (const OverwriteError&) {
      throw;
    } catch (...) {
      bar.clear();
      countFailure(caughtError(entry.image), counts, on_error);
    }
    bar.advance();
  }
}

// Joints that were placed in the window, of drawings of which nobody has labelled a candidate; by force also
// where a mask lies beside the label file that it does not name. `told`: label files that were to be made
// anew, or whose picture has changed; `kept`: those that count as such, unless they fail here.
void labelByPlacedJoints(const std::string& dir, const BodyPlans& plans, bool force,
                         const std::set<std::string>& told, const std::set<std::string>& kept,
                         const OnError& on_error, ImportCounts& counts) {
  for (const std::string& path : findLabelFiles(dir)) {
    const std::string normal = fs::path(path).lexically_normal().string();
    if (told.contains(normal)) continue;
    try {
      const LookAtOutputs look;
      const LabelFile before = readLabelFile(path);
      const auto hasNone = [](const LabelFile& file) {
        return std::all_of(file.labels.begin(), file.labels.end(), [](const auto& label) { return !label; });
      };
      const SkeletonTemplate* body_plan = planOf(before, plans);
      const std::optional<std::string> mask = maskOf(path, before);
      const bool gets_mask = force && mask && !before.mask;
      if (!before.hasPlacedJoint() || !(hasNone(before) || gets_mask) || !body_plan) continue;
      ensureUnchanged(path, before);
      LabelFile labels = labelImage(besideLabelFile(path, before.image.file), mask, before.joints, *body_plan,
                                    {}, before.recognized);
      if (hasNone(labels) && !gets_mask) continue;
      const LabelFile by_joints = labels;
      counts.classes_kept += keepClasses(labels, before, by_joints);
      counts.classes_dropped += droppedClasses(labels, before);
      writeLabelFile(path, labels);
      ++(gets_mask ? counts.masks_taken : counts.labelled);
    } catch (const InputError& error) {
      if (kept.contains(normal)) --counts.kept;
      countFailure(error, counts, on_error);
    }
  }
}

}  // namespace

ImportCounts importLabels(const std::string& path, const BodyPlans& plans, const ImportOptions& options,
                          const OnError& on_error) {
  ImportCounts counts;
  const OnInputError on_input_error = [&](const InputError& error) { countFailure(error, counts, on_error); };
  const bool is_file = fs::is_regular_file(path);
  if (is_file && !isCoco(path))
    throw InputError(path, "is no COCO file; of other annotations name the folder");
  const std::vector<AnnotatedDrawing> drawings =
      is_file ? readCoco(path, plans, on_input_error)
              : findAnnotatedDrawings(path, plans, on_input_error, &counts.passed_over);
  const std::string dir = is_file ? fs::path(path).parent_path().string() : path;
  std::set<std::string> kept;  // label files
  const auto make = [&](const AnnotatedDrawing& drawing) {
    const bool made = importDrawing(drawing, dir, plans, options, counts);
    if (!made) kept.insert(labelFileOf(drawing));
    return made;
  };
  for (const AnnotatedDrawing& drawing : drawings)
    if (!drawing.unknown.empty())
      counts.unknown_joints[drawing.source].insert(drawing.unknown.begin(), drawing.unknown.end());
  forEach(drawings, "import", on_error, make, counts);
  std::set<std::string> told;
  if (options.force)
    for (const AnnotatedDrawing& drawing : drawings) told.insert(labelFileOf(drawing));
  for (const std::string& label_path : counts.earlier)
    told.insert(fs::path(label_path).lexically_normal().string());
  if (!is_file && options.output.empty())
    labelByPlacedJoints(path, plans, options.force, told, kept, on_error, counts);
  if (drawings.empty() && counts.failed == 0 && counts.passed_over.empty() && counts.labelled == 0 &&
      counts.masks_taken == 0)
    throw InputError(path,
                     "holds nothing to import (char_cfg.yaml, joints.json, <stem>.joints.json, a COCO file "
                     "with keypoints, "
                     "or a skeleton file of the template " +
                         namesOf(plans) + ")");
  return counts;
}

ImportCounts makeLabelFiles(const std::string& dir, const OnError& on_error) {
  ImportCounts counts;
  const SkeletonTemplate body_plan = loadTemplate("biped");
  FormerNames names;
  const auto formerOf = [&](const DrawingFiles& files) {
    if (!names.hasLabelsAlone(fs::path(files.image).parent_path())) return std::string();
    return formerLabels(files.image, sha256(readFile(files.image)), names);
  };
  const auto make = [&](const DrawingFiles& files) {
    const bool is_there = fs::exists(files.labels);
    if (is_there && !isBlankLabelFile(files.labels)) return false;
    const std::string former = formerOf(files);
    if (!former.empty()) {
      LabelFile labels = readLabelFile(former);
      counts.former.push_back(files.labels + ": as in " + fs::path(former).filename().string() +
                              ", made when the picture was called " + labels.image.file);
      labels.image.file = fs::path(files.image).filename().string();
      writeLabelFile(files.labels, labels);
    } else if (!is_there) {
      writeLabelFile(files.labels, labelImage(files.image, givenMask(files), {}, body_plan));
    }
    return !former.empty() || !is_there;
  };
  const std::vector<DrawingFiles> drawings = findDrawings(dir);
  forEach(drawings, "candidates", on_error, make, counts);
  return counts;
}

}  // namespace skel
