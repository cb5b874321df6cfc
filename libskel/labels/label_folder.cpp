#include "libskel/labels/label_folder.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/core/files.h"
#include "libskel/core/foreign_files.h"
#include "libskel/core/sha256.h"
#include "libskel/core/text.h"
#include "libskel/core/tool_command.h"
#include "libskel/image/result_picture.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/skeleton/body_plans.h"
#include "libskel/skeleton/skeleton_file.h"
#include "libskel/skeleton/template.h"

namespace skel {
namespace {

namespace fs = std::filesystem;

std::string nameBelow(const std::string& dir, const std::string& file) {
  const std::string name = fs::path(file).lexically_relative(dir).string();
  return name.ends_with(kLabelFileEnding) ? name.substr(0, name.size() - std::string(kLabelFileEnding).size())
                                          : name;
}

std::string gridComplaint(const std::string& path, const LabelFile& labels, const std::string& first_path,
                          int first_size) {
  return path + ": grid: the long side is " + std::to_string(labels.gridSize()) + " px, in " + first_path +
         " it is " + std::to_string(first_size) + " px; label one of them anew";
}

// Candidates without class are left out.
LabelledCharacter characterOf(const std::string& name, const LabelFile& labels) {
  CandidateSet candidates;
  candidates.maxima = labels.candidates;
  LabelledCharacter character{name, features(candidates), {}, labels.image.sha256};
  Eigen::Index kept = 0;
  for (std::size_t i = 0; i < labels.labels.size(); ++i)
    if (labels.labels[i]) {
      character.features.row(kept++) = character.features.row(static_cast<Eigen::Index>(i)).eval();
      character.labels.push_back(*labels.labels[i]);
    }
  character.features.conservativeResize(kept, Eigen::NoChange);
  return character;
}

template <class Step>
void attempt(const OnInputError& on_error, const Step& step) {
  try {
    step();
  } catch (const InputError& error) {
    if (!on_error) throw;
    on_error(error);
  }
}

struct JointedImage {
  std::string image;  // path
  std::optional<std::string> mask;
  std::string joints_file;
  NamedJoints joints;
  std::vector<std::string> recognized;
};

std::vector<JointedImage> annotatedImages(const std::string& dir, const OnInputError& on_error) {
  std::vector<JointedImage> images;
  for (const AnnotatedImage& annotated : findAnnotatedImages(dir, on_error))
    attempt(on_error, [&] {
      images.push_back(
          {annotated.image, annotated.mask, annotated.joints, readJointsFile(annotated.joints), {}});
    });
  return images;
}

// A label file's placed joints count before a joints file beside it. Sorted by the picture's path.
std::vector<JointedImage> findJointedImages(const std::string& dir, const OnInputError& on_error) {
  std::map<std::string, JointedImage> by_image;
  for (JointedImage& annotated : annotatedImages(dir, on_error))
    by_image[annotated.image] = std::move(annotated);
  const auto leaveOut = [&](const std::string& path) {
    std::erase_if(by_image, [&](const auto& known) { return labelFileFor(known.first) == path; });
  };
  const auto take = [&](const std::string& path) {
    LabelFile labels;
    try {
      labels = readLabelFile(path);
      if (!labels.hasPlacedJoint()) return;
      ensureUnchanged(path, labels);
    } catch (const InputError&) {
      leaveOut(path);
      throw;
    }
    const std::string image = besideLabelFile(path, labels.image.file);
    const auto [known, is_new] = by_image.try_emplace(image);
    JointedImage& drawing = known->second;
    if (const auto mask = maskOf(path, labels)) drawing.mask = mask;
    if (is_new) {
      drawing.image = image;
      drawing.joints_file = path;
      drawing.joints = labels.joints;
      drawing.recognized = labels.recognized;
    } else {
      overrule(drawing.joints, labels);
    }
  };
  for (const std::string& path : findLabelFiles(dir)) attempt(on_error, [&] { take(path); });
  std::vector<JointedImage> images;
  for (auto& [image, drawing] : by_image) images.push_back(std::move(drawing));
  return images;
}

// Returns what LabelledSet::sha256 is over; so does addAnnotated().
std::string addLabelFiles(const std::string& dir, const std::vector<std::string>& files,
                          const OnInputError& on_error, LabelledSet& set) {
  const BodyPlans plans = bodyPlans("auto");
  std::string hashed, first_path;
  int grid_size = 0;
  const auto take = [&](const std::string& path) {
    const LabelFile labels = readLabelFile(path);
    if (const auto problems = findProblems(path); !problems.empty())
      throw InputError(path, problems.front().substr(path.size() + 2));
    if (grid_size == 0) {
      first_path = path;
      grid_size = labels.gridSize();
    } else if (labels.gridSize() != grid_size) {
      throw InputError(path, gridComplaint(path, labels, first_path, grid_size).substr(path.size() + 2));
    }
    const std::string name = nameBelow(dir, path);
    LabelledCharacter character = characterOf(name, labels);
    hashed += name + " " + sha256(readFile(path)) + "\n";
    if (character.labels.empty() && !labels.labels.empty()) {
      set.without_class.push_back(path);
      return;
    }
    set.unlabelled += int(labels.labels.size() - character.labels.size());
    set.characters.push_back(std::move(character));
    const SkeletonTemplate* plan = planWith(jointNames(labels.joints), plans);
    if (plan && !labels.joints.empty()) set.characters.back().body_plan = plan->name;
  };
  for (const std::string& path : files) attempt(on_error, [&] { take(path); });
  return hashed;
}

std::string addAnnotated(const std::string& dir, const std::vector<JointedImage>& drawings,
                         const CandidateOptions& options, const OnInputError& on_error, LabelledSet& set) {
  const SkeletonTemplate body_plan = loadTemplate("biped");
  std::string hashed;
  std::map<std::string, std::vector<std::string>> of_other_plans;
  const auto take = [&](const JointedImage& drawing) {
    const std::string plan = otherPlanWith(jointNames(drawing.joints), {body_plan});
    if (!plan.empty() && plan != body_plan.name) {
      of_other_plans[plan].push_back(nameBelow(dir, drawing.image));
      return;
    }
    ensureJointsOf(body_plan, drawing.joints, drawing.joints_file);
    const LabelFile labels =
        labelImage(drawing.image, drawing.mask, drawing.joints, body_plan, options, drawing.recognized);
    const std::string name = nameBelow(dir, drawing.image);
    set.characters.push_back(characterOf(name, labels));
    hashed += name + " " + sha256(formatLabelFile(labels)) + "\n";
  };
  for (const JointedImage& drawing : drawings) attempt(on_error, [&] { take(drawing); });
  for (const auto& [plan, names] : of_other_plans)
    on_error({dir, otherPlanSaid(names, drawings.size(), plan, body_plan.name) +
                       "; skel-infer evaluate --template " + plan + " measures those"});
  return hashed;
}

void ensureSamples(const std::string& dir, const LabelledSet& set) {
  if (set.characters.empty() && !set.without_class.empty())
    throw InputError(dir, "no candidate has a class; place joints, or confirm those that were found, and `" +
                              toolCommand("skel-label") + " import " + shellWord(dir) +
                              "` gives them classes, or give them by hand (skel-label, key C)");
  if (set.characters.empty()) throw InputError(dir, "no drawing is left");
  if (set.sampleCount() == 0) throw InputError(dir, "no candidate has a class");
}

}  // namespace

int LabelledSet::sampleCount() const {
  int count = 0;
  for (const LabelledCharacter& character : characters) count += static_cast<int>(character.labels.size());
  return count;
}

std::array<int, kJointClassCount> LabelledSet::classCounts() const {
  std::array<int, kJointClassCount> counts{};
  for (const LabelledCharacter& character : characters)
    for (const JointClass label : character.labels) ++counts[static_cast<std::size_t>(label)];
  return counts;
}

std::vector<std::string> LabelledSet::leftOut() const {
  std::vector<std::string> said;
  if (!without_class.empty())
    said.push_back(std::to_string(without_class.size()) +
                   (without_class.size() == 1 ? " drawing" : " drawings") +
                   " without a class of any candidate, left out: " + firstFew(without_class) +
                   " (skel-label import gives classes by joints that a person has placed or confirmed)");
  if (unlabelled > 0)
    said.push_back(std::to_string(unlabelled) + (unlabelled == 1 ? " candidate" : " candidates") +
                   " without a class left out");
  return said;
}

void ensureEveryClass(const std::string& name, const LabelledSet& set) {
  const auto counts = set.classCounts();
  for (std::size_t c = 0; c < counts.size(); ++c)
    if (counts[c] == 0)
      throw InputError(name, "no candidate is labelled \"" + std::string(kJointClassNames[c]) +
                                 "\"; each of the four classes is needed to train");
}

std::vector<std::string> findLabelFiles(const std::string& dir) {
  std::vector<std::string> files = filesBelow(dir);
  noteSkeletonFiles(files);
  noteJointsFiles(files);
  std::erase_if(files, [](const std::string& file) { return !file.ends_with(kLabelFileEnding); });
  return files;
}

std::string picturesWithout(const std::string& what, const std::string& dir,
                            const std::function<bool(const std::string& image)>& has) {
  std::vector<std::string> pictures = filesBelow(dir), without;
  std::erase_if(pictures,
                [](const std::string& file) { return !isDrawingName(fs::path(file).filename().string()); });
  passOverConverted(pictures);
  for (const std::string& picture : pictures)
    if (!has(picture)) without.push_back(nameBelow(dir, picture));
  if (without.empty()) return "";
  return std::to_string(without.size()) + " of " + std::to_string(pictures.size()) + " pictures have no " +
         what + " (" + firstFew(without) + ")";
}

std::vector<std::string> checkLabelFolder(const std::string& dir) {
  std::vector<std::string> lines;
  std::string first_path;
  int first_size = 0;
  for (const std::string& path : findLabelFiles(dir)) {
    const auto problems = findProblems(path);
    lines.insert(lines.end(), problems.begin(), problems.end());
    try {
      const LabelFile labels = readLabelFile(path);
      if (first_size == 0) {
        first_path = path;
        first_size = labels.gridSize();
      } else if (labels.gridSize() != first_size) {
        lines.push_back(gridComplaint(path, labels, first_path, first_size));
      }
    } catch (const InputError&) {
      // Among `problems` already.
    }
  }
  return lines;
}

LabelledSet readLabelledSet(const std::string& dir, const OnInputError& on_error) {
  const std::vector<std::string> files = findLabelFiles(dir);
  if (files.empty()) throw InputError(dir, "holds no label files (*" + std::string(kLabelFileEnding) + ")");
  LabelledSet set;
  const std::string hashed = addLabelFiles(dir, files, on_error, set);
  ensureSamples(dir, set);
  set.sha256 = sha256(hashed);
  return set;
}

LabelledSet labelAnnotatedImages(const std::string& dir, const CandidateOptions& options,
                                 const OnInputError& on_error) {
  LabelledSet set;
  bool any_left_out = false;
  const OnInputError leave_out = [&](const InputError& error) {
    if (!on_error) throw error;
    any_left_out = true;
    on_error(error);
  };
  const std::string hashed = addAnnotated(dir, findJointedImages(dir, leave_out), options, leave_out, set);
  if (set.characters.empty() && !any_left_out)
    throw InputError(dir,
                     "holds no pictures with joints (*.joints.json, or *.labels.json of which a person "
                     "has placed a joint)");
  ensureSamples(dir, set);
  set.sha256 = sha256(hashed);
  return set;
}

LabelledSet readMeasuredSet(const std::string& dir, const OnInputError& on_error) {
  const std::vector<std::string> files = findLabelFiles(dir);
  if (files.empty()) return labelAnnotatedImages(dir, {}, on_error);
  LabelledSet set;
  std::string hashed = addLabelFiles(dir, files, on_error, set);
  std::vector<JointedImage> others = annotatedImages(dir, on_error);
  std::erase_if(others,
                [](const JointedImage& drawing) { return fs::is_regular_file(labelFileFor(drawing.image)); });
  hashed += addAnnotated(dir, others, {}, on_error, set);
  ensureSamples(dir, set);
  set.sha256 = sha256(hashed);
  return set;
}

}  // namespace skel
