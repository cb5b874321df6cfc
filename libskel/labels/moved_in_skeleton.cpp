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

}  // namespace

std::optional<MovedInSkeleton> movedInSkeleton(const std::string& label_file, const LabelFile& labels) {
  const std::string path =
      fs::path(besideLabelFile(label_file, labels.image.file)).replace_extension().string() +
      kSkeletonFileEnding;
  try {
    if (!hasEditedJoint(path)) return std::nullopt;
    const std::string text = readFile(path);
    const SkeletonFile file = parseSkeletonFile(text, path, loadTemplate(templateOfSkeleton(text, path)));
    if (file.figure.number != 1 || file.image_sha256 != labels.image.sha256) return std::nullopt;
    std::vector<std::string> moved = movedJoints(file, labels);
    return moved.empty() ? std::nullopt : std::optional(MovedInSkeleton{path, std::move(moved)});
  } catch (const InputError&) {
    return std::nullopt;  // whoever takes its joints says what is wrong with it
  }
}

std::string movedInSkeletonNote(const std::vector<std::string>& skeleton_files) {
  return firstAndMore(skeleton_files) +
         " places joints elsewhere than the label file beside it; the label file counts (skel-label import "
         "--force takes the skeleton's)";
}

}  // namespace skel
