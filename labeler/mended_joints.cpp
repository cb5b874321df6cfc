#include "labeler/mended_joints.h"

#include "libskel/core/files.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/mended/mended_files.h"
#include "libskel/skeleton/skeleton_file.h"

namespace skel {
namespace {

// Of labels of another picture, or of no body plan that is asked for, nothing is taken.
bool mayPlace(const LabelFile& labels, const std::string& image_sha256, const BodyPlans& plans) {
  return labels.image.sha256 == image_sha256 &&
         (labels.joints.empty() || planWith(jointNames(labels.joints), plans));
}

}  // namespace

bool isMendedBeside(const DrawingFiles& files) {
  const std::string path = skeletonBeside(files);
  return sourceOfSkeleton(path) && hasEditedJoint(path);
}

std::optional<MendedJoints> mendedJointsBeside(const DrawingFiles& files, const LabelDocument& document,
                                               const std::string& image_sha256, const BodyPlans& plans) {
  if (!isMendedBeside(files)) return std::nullopt;
  const std::optional<LabelFile>& labels = document.opened();
  const std::string path = skeletonBeside(files);
  const SkeletonSource source = readSkeletonSource(path);
  if (source.image_sha256 != image_sha256 || source.number != 1) return std::nullopt;
  const SkeletonTemplate* plan = findPlan(templateOfSkeleton(readFile(path), path), plans);
  if (!plan) return std::nullopt;
  const SkeletonFile file = readSkeletonFile(path, *plan);

  MendRequest request;
  request.source = files.image;
  request.image_sha256 = image_sha256;
  MendedFiles mended;
  mended.skeleton = path;
  if (labels && mayPlace(*labels, image_sha256, plans)) mended.labels = document.path();
  RigOptions rig;
  rig.body_plan = plans.front();
  if (plans.size() > 1) rig.otherwise = {plans[1], {}};
  Image size;
  size.width = file.image_width, size.height = file.image_height;
  const PlacedJoints placed = placedJoints(mended, request, rig, size);
  if (placed.joints.empty()) return std::nullopt;

  MendedJoints result{&planNamed(placed.body_plan, plans), {}};
  result.joints.resize(result.body_plan->joints.size());
  if (!mended.labels.empty() && planOf(*labels, plans) == result.body_plan && !labels->joints.empty())
    takeJoints(*labels, *result.body_plan, result.joints);
  else if (plan == result.body_plan)
    takeJoints(file.skeleton, *plan, result.joints);
  for (auto& joint : result.joints)
    if (joint && joint->origin == JointOrigin::kEdited) joint->origin = JointOrigin::kRecognized;
  for (const auto& [name, place] : placed.joints)
    result.joints[size_t(result.body_plan->find(name))] = PlacedJoint{place, 1, JointOrigin::kEdited};
  deriveMidpoints(result.joints, *result.body_plan);
  return result;
}

}  // namespace skel
