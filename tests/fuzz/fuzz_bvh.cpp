// BVH files; what is read is retargeted.
#include "libskel/animation/retarget_motion.h"
#include "libskel/animation/sample_pose.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/figure.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  static const Skeleton skeleton = figureSkeleton();
  mayRefuse([&] {
    const BvhMotion motion = parseBvh(textOf(data, size), "fuzz.bvh");
    // A long one is only more of the same.
    if (motion.clip.duration_s() > 20) return;
    const Clip clip = retargetMotion(motion, "fuzz.bvh", skeleton, shapeOfBones(skeleton)).clip;
    for (const Eigen::Quaternionf& rotation : samplePose(clip, skeleton, 0.1f).rotations)
      require(std::abs(rotation.norm() - 1) < 1e-3f, "rotations are rotations");
  });
  return 0;
}
