#include "trainer/jointed_drawing.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <locale>
#include <map>
#include <sstream>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/json.h"
#include "libskel/core/sha256.h"
#include "libskel/core/text.h"
#include "libskel/image/read_image.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/labels/moved_in_skeleton.h"
#include "libskel/skeleton/body_plans.h"
#include "libskel/skeleton/skeleton_file.h"

namespace skel {
namespace {

namespace fs = std::filesystem;

std::string beside(const std::string& file, const std::string& relative) {
  return (fs::path(file).parent_path() / relative).lexically_normal().string();
}

void ensureUnchanged(const std::string& path, const SkeletonFile& file) {
  const auto check = [&](const char* key, const std::string& name, const std::string& hash) {
    if (!hash.empty() && sha256(readFile(beside(path, name))) != hash)
      throw InputError(path, std::string(key) + ".file: \"" + name +
                                 "\" has changed since its joints were placed; find them anew (skel-infer)");
  };
  check("image", file.image_file, file.image_sha256);
  if (file.mask) check("mask", file.mask->file, file.mask->sha256);
}

JointedDrawing fromSkeleton(const std::string& path, const SkeletonFile& file) {
  JointedDrawing drawing{beside(path, file.image_file), std::nullopt, path, {}, false};
  if (file.mask)
    drawing.mask = beside(path, file.mask->file);
  else if (file.figure.number == 1)
    drawing.mask = maskBeside(drawing.image);
  for (const Joint& joint : file.skeleton.joints) drawing.joints.emplace_back(joint.name, joint.image);
  return drawing;
}

JointedDrawing fromLabels(const std::string& path, const LabelFile& file) {
  return {besideLabelFile(path, file.image.file), maskOf(path, file), path, file.joints, false};
}

void ensureBodyPlan(const std::string& dir, const std::vector<JointedDrawing>& drawings,
                    const SkeletonTemplate& body_plan) {
  std::map<std::string, std::vector<std::string>> of_other_plans;
  for (const JointedDrawing& drawing : drawings)
    if (const std::string plan = otherPlanWith(jointNames(drawing.joints), {body_plan}); !plan.empty())
      of_other_plans[plan].push_back(fs::path(drawing.joints_file).lexically_relative(dir).string());
  if (of_other_plans.empty()) return;
  const auto& [plan, names] = *of_other_plans.begin();
  throw InputError(dir, otherPlanSaid(names, drawings.size(), plan, body_plan.name) + ": --template " + plan +
                            " takes those, in a folder of their own");
}

}  // namespace

std::vector<JointedDrawing> findJointedDrawings(const std::string& dir) {
  std::map<std::string, JointedDrawing> by_image;
  std::vector<InputError> changed;
  const auto check = [&](const std::string& path, const auto& file) {
    try {
      ensureUnchanged(path, file);
    } catch (const InputError& error) {
      changed.push_back(error);
    }
  };
  const auto add = [&](JointedDrawing drawing, const auto& file) {
    const std::string path = drawing.joints_file, image = fs::path(drawing.image).lexically_normal().string();
    if (by_image.try_emplace(image, std::move(drawing)).second) check(path, file);
  };
  std::vector<std::string> overruled, overruled_skeletons;
  for (const AnnotatedImage& files : findAnnotatedImages(dir)) {
    JointedDrawing drawing{files.image,
                           files.mask,
                           files.joints,
                           readJointsFile(files.joints),
                           readView(files.joints) == "side",
                           readFacing(files.joints)};
    if (const auto labels = placedLabelsBeside(files.image)) {
      const std::string path = labelFileFor(files.image);
      check(path, *labels);
      if (labels->mask) drawing.mask = besideLabelFile(path, labels->mask->file);
      if (!overrule(drawing.joints, *labels).empty()) overruled.push_back(drawing.joints_file = path);
    }
    by_image[fs::path(files.image).lexically_normal().string()] = std::move(drawing);
  }
  if (!overruled.empty()) std::fprintf(stderr, "skel-train: note: %s\n", overruledNote(overruled).c_str());
  const std::vector<std::string> all = filesBelow(dir);
  std::map<std::string, std::string> skipped;  // files without a joint that a person has placed, by image
  for (const std::string& path : all) {
    if (!path.ends_with(kLabelFileEnding)) continue;
    const LabelFile file = readLabelFile(path);
    if (!file.hasPlacedJoint()) {
      skipped.emplace(fs::path(besideLabelFile(path, file.image.file)).lexically_normal().string(), path);
      continue;
    }
    JointedDrawing drawing = fromLabels(path, file);
    if (!jointsFileBeside(drawing.image))
      if (const auto moved = movedInSkeleton(path, file)) overruled_skeletons.push_back(moved->file);
    add(std::move(drawing), file);
  }
  if (!overruled_skeletons.empty())
    std::fprintf(stderr, "skel-train: note: %s\n", movedInSkeletonNote(overruled_skeletons).c_str());
  for (const std::string& path : all) {
    if (!path.ends_with(kSkeletonFileEnding)) continue;
    if (!hasEditedJoint(path)) {
      if (const auto source = sourceOfSkeleton(path)) skipped.emplace(beside(path, source->image_file), path);
      continue;
    }
    const std::string body_plan = JsonDocument::readFile(path).root().at("template").asString();
    const SkeletonFile file = readSkeletonFile(path, loadTemplate(body_plan));
    add(fromSkeleton(path, file), file);
  }
  if (by_image.empty())
    throw InputError(dir,
                     "has no drawing with known joints: *.joints.json, or *.labels.json or *.skeleton.json "
                     "of which a person has placed a joint");
  if (changed.size() == 1) throw InputError(changed.front());
  if (!changed.empty()) {
    std::vector<std::string> others;
    for (std::size_t i = 1; i < changed.size(); ++i) others.push_back(changed[i].file());
    throw InputError(changed.front().file(), changed.front().problem() + "; the same of " +
                                                 std::to_string(others.size()) + " more: " + joined(others));
  }
  std::vector<std::string> unplaced;
  for (const auto& [image, path] : skipped)
    if (!by_image.contains(image)) unplaced.push_back(path);
  if (!unplaced.empty())
    std::fprintf(stderr, "skel-train: note: %s: without a joint that a person has placed, not learned from\n",
                 firstAndMore(unplaced).c_str());
  std::vector<JointedDrawing> drawings;
  for (auto& [image, drawing] : by_image) drawings.push_back(std::move(drawing));
  return drawings;
}

std::vector<JointedDrawing> findJointedDrawings(const std::vector<std::string>& dirs) {
  std::vector<JointedDrawing> drawings;
  for (const std::string& dir : dirs)
    for (JointedDrawing& found : findJointedDrawings(dir)) drawings.push_back(std::move(found));
  return drawings;
}

std::vector<JointedDrawing> findJointedDrawings(const std::vector<std::string>& dirs,
                                                const SkeletonTemplate& body_plan) {
  std::vector<JointedDrawing> drawings;
  for (const std::string& dir : dirs) {
    std::vector<JointedDrawing> found = findJointedDrawings(dir);
    ensureBodyPlan(dir, found, body_plan);
    std::move(found.begin(), found.end(), std::back_inserter(drawings));
  }
  return drawings;
}

std::string contentOf(const std::vector<JointedDrawing>& drawings) {
  if (drawings.empty()) return "none";
  std::ostringstream all;
  all.imbue(std::locale::classic());
  all.precision(17);
  for (const JointedDrawing& drawing : drawings) {
    all << sha256(readFile(drawing.image)) << ' ' << (drawing.mask ? sha256(readFile(*drawing.mask)) : "none")
        << ' ' << drawing.side_view;
    for (const auto& [name, place] : drawing.joints) {
      all << ' ' << name;
      if (place) all << ' ' << place->x() << ' ' << place->y();
    }
    all << '\n';
  }
  return std::to_string(drawings.size()) + " drawings (sha256 " + sha256(all.str()).substr(0, 16) + ")";
}

Silhouette silhouetteOf(const Image& image, const JointedDrawing& drawing) {
  Silhouette silhouette =
      drawing.mask ? silhouetteFromMask(readMaskOf(image, *drawing.mask)) : extractSilhouette(image);
  if (!silhouette.found()) throw InputError(drawing.mask.value_or(drawing.image), silhouette.reason);
  return silhouette;
}

}  // namespace skel
