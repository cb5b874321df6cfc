// Templates; with what is read a figure is rigged.
#include "libskel/skeleton/template.h"
#include "tests/fuzz/rig_checks.h"
#include "tests/support/synthetic_figure.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  static const Image image = capsuleImage({.size = 64});
  mayRefuse([&] {
    RigOptions options = rigOptions(size);
    options.recognizer = Recognizer::kPaper;  // the net knows the biped alone
    options.body_plan = parseTemplate(textOf(data, size), "fuzz");
    RigInput input;
    input.image = image;
    requireSound(rigCharacter(std::move(input), options));
  });
  return 0;
}
