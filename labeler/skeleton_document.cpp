#include "labeler/skeleton_document.h"

#include <algorithm>
#include <filesystem>

#include "libskel/core/files.h"

namespace skel {

SkeletonDocument::SkeletonDocument(std::string path, const BodyPlans& plans)
    : path_(std::move(path)),
      body_plan_(planNamed(templateOfSkeleton(readFile(path_), path_), plans)),
      file_(readSkeletonFile(path_, body_plan_)) {}

DrawingFiles SkeletonDocument::drawing() const {
  return drawingFiles(besideFile(path_, file_.image_file),
                      std::filesystem::path(file_.image_file).filename().string(), figureNumber());
}

std::string SkeletonDocument::maskPath() const { return besideFile(path_, file_.mask->file); }

void SkeletonDocument::checkSize(const Image& image, const std::string& image_path) const {
  checkMeansPicture(image, image_path, file_.image_width, file_.image_height, path_, "image");
}

void SkeletonDocument::write(const Content& content) const {
  SkeletonFile file = file_;
  const DrawingJoints& joints = content.state.joints;
  placeJoints(joints, body_plan_, file.skeleton);
  for (Joint& joint : file.skeleton.joints) {
    const auto& place = joints[static_cast<size_t>(body_plan_.find(joint.name))];
    if (!place) continue;
    if (place->origin == JointOrigin::kEdited) std::erase(file.missing, joint.name);
    // Joints that were found anew must not look as if somebody had moved them.
    if (content.lifted)
      for (const Joint& lifted : content.lifted->joints)
        if (lifted.name == joint.name && lifted.image == joint.image) joint.position = lifted.position;
  }
  if (!file.image_sha256.empty()) file.image_sha256 = content.state.image_sha256;
  const MaskVersion* mask = content.state.mask.get();
  if (content.silhouette.found()) {
    if (!mask) file.figure.number = std::min(figureNumber(), content.silhouette.figure_count);
    file.figure.sha256 = mask ? outlineHash(content.silhouette) : content.found_outline;
    file.figure.found_sha256 = mask ? content.found_outline : "";
  }
  if (!mask)
    file.mask.reset();
  else if (file.mask && content.same_mask)
    file.mask->sha256 = mask->sha256;  // it may have changed since
  else
    file.mask = SkeletonFile::Mask{pathSeenFrom(path_, content.mask_path), mask->sha256};
  // Whoever saves has looked at them.
  for (auto* painted : {&file.mask, &file.limbs})
    if (*painted) (*painted)->before = false;
  // What was said of joints before somebody moved them is stale.
  if (std::any_of(file.skeleton.joints.begin(), file.skeleton.joints.end(),
                  [](const Joint& joint) { return joint.origin == JointOrigin::kEdited; }))
    file.warnings.clear();
  replaceFile(path_, formatSkeletonFile(file));
}

}  // namespace skel
