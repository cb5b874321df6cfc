#include "libskel/layers/find_limbs.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace skel {
namespace {

using Vec = Eigen::Vector2d;

std::optional<PartSkeleton> partSkeletonOf(const Skeleton& skeleton, const SkeletonTemplate& body_plan) {
  bool complete = knowsParts(body_plan);
  const auto at = [&](int joint) -> Vec {
    const int found = joint < 0 ? -1 : skeleton.find(body_plan.joints[static_cast<std::size_t>(joint)].name);
    complete = complete && found >= 0;
    return found < 0 ? Vec(Vec::Zero())
                     : Vec(skeleton.joints[static_cast<std::size_t>(found)].image + Vec(.5, .5));
  };
  if (!complete) return std::nullopt;
  PartSkeleton out;
  out.head = at(body_plan.head), out.body = at(body_plan.body);
  for (std::size_t k = 0; k < out.limbs.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i) out.limbs[k][i] = at(body_plan.limbs[k].joints[i]);
  const int root = body_plan.find("tail_root"), tail = body_plan.find("tail");
  out.animal = body_plan.from_side && root >= 0 && tail >= 0;
  if (out.animal) out.tail_root = at(root), out.tail = at(tail);
  return complete ? std::optional(out) : std::nullopt;
}

LimbConfidences confidencesOf(const Skeleton& skeleton, const SkeletonTemplate& body_plan) {
  LimbConfidences confidences;
  for (std::size_t k = 0; k < confidences.of_limb.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      const int joint = body_plan.limbs[k].joints[i];
      const int found = skeleton.index(body_plan.joints[static_cast<std::size_t>(joint)].name);
      confidences.of_limb[k][i] = skeleton.joints[static_cast<std::size_t>(found)].confidence;
    }
  for (const Joint& joint : skeleton.joints)
    confidences.mean += joint.confidence / static_cast<double>(skeleton.joints.size());
  return confidences;
}

}  // namespace

std::optional<FoundLimbs> findLimbs(const Image& image, const Silhouette& silhouette,
                                    const Skeleton& skeleton, const SkeletonTemplate& body_plan,
                                    const PartNet& net) {
  const std::optional<PartSkeleton> bones = partSkeletonOf(skeleton, body_plan);
  if (!bones) return std::nullopt;
  FoundLimbs found{
      findParts(image, silhouette.mask, *bones, net), *bones, confidencesOf(skeleton, body_plan), {}};
  found.borders = limbBorders(found.picture, *bones);
  return found;
}

LimbEvidence limbEvidence(const FoundLimbs& found, int limb) {
  return limbEvidence(found.picture, found.skeleton, found.confidences,
                      found.borders[static_cast<std::size_t>(limb)], limb);
}

}  // namespace skel
