#include "labeler/label_report.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

#include "labeler/annotated_drawing.h"
#include "labeler/joints_outside_mask.h"
#include "labeler/placed_joints.h"
#include "labeler/save_drawing.h"
#include "libskel/classifier/features.h"
#include "libskel/core/error.h"
#include "libskel/core/text.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/labels/label_file.h"
#include "libskel/labels/label_folder.h"
#include "libskel/labels/moved_in_skeleton.h"
#include "libskel/labels/twins.h"

namespace skel {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> labelFiles(const std::string& dir) {
  std::vector<std::string> files = findLabelFiles(dir);
  if (files.empty())
    throw InputError(dir, "holds no label files (" + std::string("*") + kLabelFileEnding +
                              "): make some with skel-label candidates or import");
  return files;
}

Silhouette labelledFigure(const std::string& path, const LabelFile& labels) {
  return silhouetteOf(besideLabelFile(path, labels.image.file), maskOf(path, labels));
}

void checkJointNames(const std::string& path, const LabelFile& labels, const SkeletonTemplate& body_plan,
                     std::vector<std::string>& lines) {
  for (const auto& [name, place] : labels.joints)
    if (body_plan.find(name) < 0)
      lines.push_back(path + ": joints." + name + ": is no joint of the template " + body_plan.name);
}

// Joints that the joints file has elsewhere; none of one that cannot be read, as checkJointsFiles() says.
std::vector<std::string> movedFromJointsFile(const std::string& joints_file, const LabelFile& labels) {
  try {
    NamedJoints joints = readJointsFile(joints_file);
    return overrule(joints, labels);
  } catch (const InputError&) {
    return {};
  }
}

// Beside labels, of a file that does not count.
struct OtherJoints {
  std::string file;
  std::vector<std::string> joints;
  bool of_skeleton = false;
};

std::optional<OtherJoints> otherJointsBeside(const std::string& path, const LabelFile& labels) {
  if (!labels.hasPlacedJoint()) return std::nullopt;
  if (const auto joints_file = jointsFileBeside(besideLabelFile(path, labels.image.file))) {
    std::vector<std::string> moved = movedFromJointsFile(*joints_file, labels);
    return moved.empty() ? std::nullopt : std::optional(OtherJoints{*joints_file, std::move(moved), false});
  }
  if (const auto moved = movedInSkeleton(path, labels)) return OtherJoints{moved->file, moved->joints, true};
  return std::nullopt;
}

void checkOtherJoints(const std::string& path, const LabelFile& labels, std::vector<std::string>& lines) {
  if (const auto other = otherJointsBeside(path, labels))
    lines.push_back(
        path + ": joints: " + joined(other->joints) +
        (other->of_skeleton
             ? " set by hand in " + other->file +
                   ", and not so here; that does not count: take it by skel-label import --force, or "
                   "mend it"
             : " placed elsewhere than in " + other->file + ", which does not count: mend or remove that"));
}

void checkRecognized(const std::string& path, const LabelFile& labels, std::vector<std::string>& lines) {
  if (const auto moved = movedButRecognized(path, labels); !moved.empty())
    lines.push_back(path + ": joints: " + joined(moved) + " moved, but still called recognized: take " +
                    (moved.size() == 1 ? "it" : "them") + " out of \"recognized\"");
}

void checkMask(const std::string& path, const LabelFile& labels, const SkeletonTemplate& body_plan,
               std::vector<std::string>& lines) {
  const std::optional<std::string> mask = maskOf(path, labels);
  if (!mask) return;
  if (const std::string outside = jointsOutsideMask(labels, body_plan, *mask); !outside.empty())
    lines.push_back(path + ": mask: " + outside);
}

void checkFigure(const std::string& path, const LabelFile& labels, const Silhouette& silhouette,
                 std::vector<std::string>& lines) {
  if (silhouette.mask.cols() != labels.image_width || silhouette.mask.rows() != labels.image_height)
    lines.push_back(path + ": image: is " + std::to_string(silhouette.mask.cols()) + "x" +
                    std::to_string(silhouette.mask.rows()) + " px");
  if (silhouette.grid.width != labels.grid_width || silhouette.grid.height != labels.grid_height) {
    lines.push_back(path + ": grid: the figure's is " + std::to_string(silhouette.grid.width) + "x" +
                    std::to_string(silhouette.grid.height) + "; open and save it in skel-label");
    return;
  }
  using Place = std::tuple<float, float, float>;
  const auto placeOf = [](const JointCandidate& candidate) {
    return Place(candidate.x, candidate.y, candidate.radius);
  };
  const std::vector<JointCandidate> maxima = extractCandidates(silhouette).maxima;
  if (maxima.size() != labels.candidates.size()) {
    lines.push_back(path + ": candidates: are " + std::to_string(labels.candidates.size()) +
                    ", the figure has " + std::to_string(maxima.size()) + "; open and save it in skel-label");
    return;
  }
  std::set<Place> places;  // in any order: label files of others may sort them
  for (const JointCandidate& candidate : maxima) places.insert(placeOf(candidate));
  for (size_t i = 0; i < maxima.size(); ++i)
    if (!places.contains(placeOf(labels.candidates[i]))) {
      lines.push_back(path + ": candidates[" + std::to_string(i) +
                      "]: is not the figure's; open and save it in skel-label");
      return;
    }
}

std::string shown(double value) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, static_cast<float>(value)).ptr);
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + "\"";
}

std::string nameBelow(const std::string& dir, const std::string& path) {
  return fs::path(path).lexically_relative(dir).generic_string();
}

void finishSaves(const std::vector<std::string>& files) {
  for (const std::string& path : files) {
    try {
      finishSave(path);
    } catch (const InputError&) {
      // findProblems() says it.
    }
  }
}

// Also those beside label files: whoever reads those reads them, too.
void checkJointsFiles(const std::string& dir, const BodyPlans& plans, std::vector<std::string>& lines) {
  const OnInputError add = [&](const InputError& error) { lines.emplace_back(error.what()); };
  for (const AnnotatedImage& drawing : findAnnotatedImages(dir, add)) {
    try {
      const NamedJoints joints = readJointsFile(drawing.joints);
      ensureJointsOf(planOf(joints, plans), joints, drawing.joints);
    } catch (const InputError& error) {
      add(error);
    }
  }
}

// Calls `use(path, labels, figure)` for each label file that has nothing wrong; `on_error` is told of the
// others, of those of another body plan in one line.
template <class Use>
void forEachSound(const std::string& dir, const BodyPlans& plans, const OnError& on_error, const Use& use) {
  const std::vector<std::string> files = labelFiles(dir);
  finishSaves(files);
  std::map<std::string, std::vector<std::string>> of_other_plans;
  for (const std::string& path : files) {
    try {
      std::vector<std::string> lines = findProblems(path);
      if (lines.empty()) {
        const LabelFile labels = readLabelFile(path);
        const SkeletonTemplate* plan = planOf(labels, plans);
        if (!plan) {
          of_other_plans[otherPlanWith(jointNames(labels.joints), plans)].push_back(nameBelow(dir, path));
          continue;
        }
        checkJointNames(path, labels, *plan, lines);
        const Silhouette figure = labelledFigure(path, labels);
        checkFigure(path, labels, figure, lines);
        if (lines.empty()) use(path, labels, figure);
      }
      if (!lines.empty()) throw InputError(path, lines.front().substr(path.size() + 2));
    } catch (const InputError& error) {
      on_error(error);
    }
  }
  for (const auto& [plan, names] : of_other_plans)
    on_error(InputError(dir, otherPlanSaid(names, files.size(), plan, plans.front().name) +
                                 ": not exported; --template " + plan + " exports them"));
}

}  // namespace

std::vector<std::string> checkLabels(const std::string& dir, const BodyPlans& plans) {
  const std::vector<std::string> files = labelFiles(dir);
  finishSaves(files);
  std::vector<std::string> lines = checkLabelFolder(dir);
  for (const std::string& path : files) {
    if (!findProblems(path).empty()) continue;
    try {
      const LabelFile labels = readLabelFile(path);
      checkJointNames(path, labels, planOf(labels.joints, plans), lines);
      checkOtherJoints(path, labels, lines);
      checkRecognized(path, labels, lines);
      const Silhouette figure = labelledFigure(path, labels);
      checkFigure(path, labels, figure, lines);
      if (const std::string far = jointFarOutsideFigure(labels, figure.mask); !far.empty())
        lines.push_back(path + ": " + far);
      checkMask(path, labels, planOf(labels.joints, plans), lines);
    } catch (const InputError& error) {
      lines.emplace_back(path + ": " + error.what());
    }
  }
  checkJointsFiles(dir, plans, lines);
  return lines;
}

std::string twinsAmong(const std::string& dir) {
  std::vector<std::string> paths, names, sha256s;
  std::vector<NamedJoints> joints;
  for (const std::string& path : labelFiles(dir)) {
    try {
      const LabelFile labels = readLabelFile(path);
      paths.push_back(path);
      names.push_back(nameBelow(dir, besideLabelFile(path, labels.image.file)));
      sha256s.push_back(labels.image.sha256);
      joints.push_back(labels.joints);
      std::erase_if(joints.back(), [&](const auto& joint) { return !labels.isPlaced(joint.first); });
    } catch (const InputError&) {
      // checkLabels() says it.
    }
  }
  const auto figure_px = [&](std::size_t i) {
    try {
      return kWorkingGridSize / labelledFigure(paths[i], readLabelFile(paths[i])).grid.scale;
    } catch (const InputError&) {
      return 0.;
    }
  };
  return twinsSaid("drawings", names, sha256s) + twinJointsSaid(sha256s, joints, figure_px);
}

std::string unlabelledAmong(const std::string& dir) {
  return picturesWithout("labels", dir,
                         [](const std::string& image) { return fs::is_regular_file(labelFileFor(image)); });
}

std::vector<std::string> overruledAmong(const std::string& dir) {
  std::vector<std::string> label_files, skeleton_files, notes;
  for (const std::string& path : labelFiles(dir)) {
    try {
      const auto other = otherJointsBeside(path, readLabelFile(path));
      if (!other) continue;
      if (other->of_skeleton)
        skeleton_files.push_back(other->file);
      else
        label_files.push_back(path);
    } catch (const InputError&) {
      // It is not exported, and a line says why.
    }
  }
  if (!label_files.empty()) notes.push_back(overruledNote(label_files));
  if (!skeleton_files.empty()) notes.push_back(movedInSkeletonNote(skeleton_files));
  return notes;
}

std::string labelStats(const std::string& dir) {
  int done = 0, masks = 0, with_joints = 0, with_placed = 0, candidates = 0, labelled = 0;
  std::array<int, kJointClassCount> counts{};
  const std::vector<std::string> files = labelFiles(dir);
  for (const std::string& path : files) {
    const LabelFile labels = readLabelFile(path);
    int here = 0;
    for (const auto& label : labels.labels)
      if (label) ++here, ++counts[static_cast<size_t>(*label)];
    candidates += static_cast<int>(labels.labels.size());
    labelled += here;
    done += here == static_cast<int>(labels.labels.size());
    masks += labels.mask.has_value();
    with_joints += !labels.joints.empty();
    with_placed += labels.hasPlacedJoint();
  }
  std::string text;
  const auto line = [&](const char* name, int count, const std::string& note = {}) {
    char row[128];
    std::snprintf(row, sizeof row, "%-16s %6d%s\n", name, count, note.c_str());
    text += row;
  };
  const auto share = [](int part, int whole) {
    char note[32];
    std::snprintf(note, sizeof note, "  %5.1f %%", whole > 0 ? 100.0 * part / whole : 0.0);
    return std::string(note);
  };
  line("drawings", static_cast<int>(files.size()));
  line("classes finished", done, share(done, static_cast<int>(files.size())));
  line("with joints", with_joints);
  line("  placed", with_placed);
  line("with mask", masks);
  line("candidates", candidates);
  line("labelled", labelled, share(labelled, candidates));
  for (size_t c = 0; c < counts.size(); ++c)
    line((std::string("  ") + kJointClassNames[c]).c_str(), counts[c], share(counts[c], labelled));
  return text;
}

std::string labelsAsCsv(const std::string& dir, const BodyPlans& plans, const OnError& on_error) {
  std::string text;
  forEachSound(
      dir, plans, on_error, [&](const std::string& path, const LabelFile& labels, const Silhouette&) {
        CandidateSet candidates;
        candidates.maxima = labels.candidates;
        const Features rows = features(candidates);
        const std::string name = quoted(nameBelow(dir, path));
        for (size_t i = 0; i < labels.candidates.size(); ++i) {
          const JointCandidate& candidate = labels.candidates[i];
          text += name + "," + std::to_string(i);
          for (const float value : {candidate.x, candidate.y, candidate.radius}) text += "," + shown(value);
          for (int k = 0; k < 3; ++k) text += "," + shown(rows(static_cast<Eigen::Index>(i), k));
          text += std::string(",") +
                  (labels.labels[i] ? kJointClassNames[static_cast<size_t>(*labels.labels[i])] : "") + "\n";
        }
      });
  return text.empty() ? text : "file,candidate,x,y,radius,feature_x,feature_y,feature_radius,label\n" + text;
}

std::string labelsAsCoco(const std::string& dir, const BodyPlans& plans, const OnError& on_error) {
  std::vector<CocoPicture> pictures;
  forEachSound(dir, plans, on_error,
               [&](const std::string& path, const LabelFile& labels, const Silhouette& figure) {
                 pictures.push_back({nameBelow(dir, besideLabelFile(path, labels.image.file)),
                                     labels.image_width, labels.image_height, labels.joints,
                                     labels.recognized, figure.outline, !labels.mask});
               });
  return pictures.empty() ? "" : formatCoco(pictures, plans);
}

}  // namespace skel
