// Clip files and key-frame clips; what is read is played on a skeleton.
#include "libskel/animation/clip_file.h"
#include "libskel/animation/keyframe_clip.h"
#include "libskel/animation/retarget.h"
#include "libskel/animation/sample_pose.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/figure.h"

namespace skel {

void play(const Clip& clip, const Skeleton& skeleton) {
  // Short ones: a long one is only more of the same.
  if (clip.duration_s() > 20) return;
  const Clip fitted = retargetToRest(clip, skeleton);
  for (const float share : {0.0f, 0.3f, 1.0f})
    for (const Eigen::Quaternionf& rotation :
         samplePose(fitted, skeleton, share * fitted.duration_s()).rotations)
      require(std::abs(rotation.norm() - 1) < 1e-3f, "rotations are rotations");
}

}  // namespace skel

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  static const Skeleton skeleton = figureSkeleton();
  mayRefuse([&] {
    const Clip clip = parseClip(textOf(data, size), "fuzz.clip.json");
    const std::string text = formatClip(parseClip(formatClip(clip), "again.clip.json"));
    require(formatClip(parseClip(text, "again.clip.json")) == text, "what is written is read as it was");
    for (const FootContact& contact : clip.contacts)
      if (!contact.joint.ends_with("_foot") || skeleton.find(contact.joint) < 0) return;
    play(clip, skeleton);
  });
  mayRefuse(
      [&] { play(parseKeyframeClip(textOf(data, size), "fuzz.json", skeleton, {.z_up = true}), skeleton); });
  return 0;
}
