// Pose files; what is read is written again and moves the figure.
#include "animator/pose_file.h"
#include "libskel/deform/skin_vertices.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/figure.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  static const Skeleton skeleton = figureSkeleton();
  mayRefuse([&] {
    const Pose pose = parsePose(textOf(data, size), "fuzz.pose.json", skeleton);
    require(pose.rotations.size() == skeleton.joints.size(), "there is one rotation a joint");
    for (const Eigen::Quaternionf& rotation : pose.rotations)
      require(std::abs(rotation.norm() - 1) < 1e-3f, "rotations are rotations");
    const std::string text = formatPose(pose, skeleton);
    formatPose(parsePose(text, "again.pose.json", skeleton), skeleton);
    posedFromRest(skeleton, pose, 1.7f);
  });
  return 0;
}
