// Motion files.
#include "libskel/skeleton/motion_file.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  static const SkeletonTemplate body_plan = loadTemplate("biped");
  mayRefuse([&] {
    const std::string text = formatMotionFile(
        readMotionFile(fileOf(textOf(data, size), "fuzz.motion.json"), body_plan), body_plan);
    require(formatMotionFile(readMotionFile(fileOf(text, "again.motion.json"), body_plan), body_plan) == text,
            "what is written is read as it was");
  });
  return 0;
}
