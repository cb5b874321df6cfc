#include "libskel/labels/moved_in_skeleton.h"

#include <algorithm>
#include <filesystem>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/text.h"
#include "libskel/skeleton/skeleton_file.h"

namespace skel {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> movedJoints(const SkeletonFile& file, const LabelFile& labels) {
  const auto isPlacedThere = [&](const Joint& joint) {
    return labels.isPlaced(joint.name) &&
           std::any_of(labels.joints.begin(), labels.joints.end(), [&](const auto& other) {
             return other.first == joint.name && other.second && isSamePlace(*other.second, joint.image);
           });
  };
  const auto isOfLabels = [&](const Joint& joint) {
    if (!file.labels) return false;
    const auto taken = file.labels->joints.find(joint.name);
    return taken != file.labels->joints.end() && isSamePlace(taken->second, joint.image);
  };
  std::vector<std::string> moved;
  for (const Joint& joint : file.skeleton.joints)
    if (joint.origin == JointOrigin::kEdited && !isPlacedThere(joint) && !isOfLabels(joint))
      moved.push_back(joint.name);
  return moved;
}

std::string skeletonBesideLabels(const std::string& label_file, const LabelFile& labels) {
  return fs::path(besideLabelFile(label_file, labels.image.file)).replace_extension().string() +
         kSkeletonFileEnding;
}

// Nothing where it is not of this very picture and its first figure. Throws InputError.
std::optional<SkeletonFile> readSkeletonOf(const std::string& path, const LabelFile& labels) {
  const std::string text = readFile(path);
  SkeletonFile file = parseSkeletonFile(text, path, loadTemplate(templateOfSkeleton(text, path)));
  if (file.figure.number != 1 || file.image_sha256 != labels.image.sha256) return std::nullopt;
  return file;
}

bool haveSameMask(const SkeletonFile& file, const LabelFile& labels) {
  return file.mask.has_value() == labels.mask.has_value() &&
         (!file.mask || file.mask->sha256 == labels.mask->sha256);
}

}  // namespace

std::optional<MovedInSkeleton> movedInSkeleton(const std::string& label_file, const LabelFile& labels) {
  const std::string path = skeletonBesideLabels(label_file, labels);
  try {
    if (!hasEditedJoint(path)) return std::nullopt;
    const auto file = readSkeletonOf(path, labels);
    if (!file) return std::nullopt;
    std::vector<std::string> moved = movedJoints(*file, labels);
    return moved.empty() ? std::nullopt : std::optional(MovedInSkeleton{path, std::move(moved)});
  } catch (const InputError&) {
    return std::nullopt;  // whoever takes its joints says what is wrong with it
  }
}

std::vector<std::string> movedButRecognized(const std::string& label_file, const LabelFile& labels) {
  const std::string path = skeletonBesideLabels(label_file, labels);
  std::error_code unknown;
  if (labels.recognized.empty() || !fs::is_regular_file(path, unknown)) return {};
  try {
    const auto file = readSkeletonOf(path, labels);
    if (!file || !haveSameMask(*file, labels)) return {};
    std::vector<std::string> moved;
    std::size_t unmoved = 0;
    for (const auto& [name, place] : labels.joints) {
      const int j = file->skeleton.find(name);
      if (!place || labels.isPlaced(name) || j < 0) continue;
      const Joint& found = file->skeleton.joints[static_cast<std::size_t>(j)];
      if (found.origin == JointOrigin::kDerived || found.origin == JointOrigin::kEdited) continue;
      if (isSamePlace(*place, found.image))
        ++unmoved;
      else
        moved.push_back(name);
    }
    return moved.size() < unmoved ? moved : std::vector<std::string>();
  } catch (const InputError&) {
    return {};  // as above
  }
}

std::string movedInSkeletonNote(const std::vector<std::string>& skeleton_files) {
  return firstAndMore(skeleton_files) +
         " places joints elsewhere than the label file beside it; the label file counts (skel-label import "
         "--force takes the skeleton's)";
}

}  // namespace skel
