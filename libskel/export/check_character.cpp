#include "libskel/export/check_character.h"

#include <cmath>
#include <numbers>

#include "libskel/animation/check_clip.h"
#include "libskel/animation/clip_limits.h"
#include "libskel/core/error.h"
#include "libskel/mesh/check_mesh.h"
#include "libskel/skeleton/check_skeleton.h"
#include "libskel/skeleton/joint_lookup.h"

namespace skel {

void checkCharacter(const RiggedCharacter& character, const std::vector<Clip>& clips) {
  const auto& [mesh, skeleton, skin, facing] = character;
  if (mesh.vertices.rows() == 0 && skin.joints.rows() == 0)
    throw UsageError(
        "the character has no mesh: no figure was found, or rigging ended before the stage that makes it");
  checkMesh(mesh, "RiggedCharacter::mesh");
  checkSkeleton(skeleton, "RiggedCharacter::skeleton");
  const Eigen::Index vertices = mesh.vertices.rows();
  if (skin.joints.rows() != vertices || skin.weights.rows() != vertices)
    throw UsageError("RiggedCharacter::weights has " + std::to_string(skin.joints.rows()) +
                     " rows of joints and " + std::to_string(skin.weights.rows()) + " of weights for " +
                     std::to_string(vertices) + " vertices");
  if (std::size_t(skin.joints.maxCoeff()) >= skeleton.joints.size())
    throw UsageError("RiggedCharacter::weights.joints names a joint that there is not, of " +
                     std::to_string(skeleton.joints.size()));
  if (!skin.weights.allFinite())
    throw UsageError("RiggedCharacter::weights.weights holds a number that is not finite");
  if (facing && !(std::abs(facing->yaw_rad) <= std::numbers::pi))
    throw UsageError("RiggedCharacter::facing must lie between -pi and pi");
  const JointLookup joints(skeleton);
  for (const Clip& clip : clips) {
    checkClip(clip);
    checkTimes(clip);
    for (const JointTrack& track : clip.tracks)
      if (joints.find(track.joint) < 0)
        throw UsageError("the clip \"" + clip.name + "\" moves \"" + track.joint +
                         "\", which this skeleton lacks");
  }
}

}  // namespace skel
