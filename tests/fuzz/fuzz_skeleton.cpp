// Skeleton files; with what is read a figure is rigged.
#include "libskel/skeleton/skeleton_file.h"
#include "tests/fuzz/rig_checks.h"
#include "tests/support/synthetic_figure.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  static const Image image = capsuleImage({.size = 64});
  mayRefuse([&] {
    const RigOptions options = rigOptions(size);
    const std::string path = fileOf(textOf(data, size), "fuzz.skeleton.json");
    mayRefuse([&] { hasEditedJoint(path); });
    const SkeletonFile file = readSkeletonFile(path, options.body_plan);
    const std::string text = formatSkeletonFile(file);
    require(
        formatSkeletonFile(readSkeletonFile(fileOf(text, "again.skeleton.json"), options.body_plan)) == text,
        "what is written is read as it was");
    RigInput input;
    input.image = image;
    input.skeleton = file.skeleton;
    requireSound(rigCharacter(std::move(input), options));
  });
  return 0;
}
