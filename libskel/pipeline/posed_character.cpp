#include "libskel/pipeline/posed_character.h"

#include <cmath>

#include "libskel/animation/sample_pose.h"

namespace skel {

float heightOf(const RiggedCharacter& character) {
  const Eigen::MatrixX3f& v = character.mesh.vertices;
  return v.rows() > 0 ? v.col(1).maxCoeff() - v.col(1).minCoeff() : float(kModelHeight_m);
}

JointTransforms posedAt(const RiggedCharacter& character, const Clip& clip, double time_s) {
  const double duration_s = double(clip.duration_s());
  if (duration_s > 0 && time_s > duration_s) time_s = std::fmod(time_s, duration_s);
  return posedFromRest(character.skeleton, samplePose(clip, character.skeleton, float(time_s)),
                       heightOf(character));
}

}  // namespace skel
