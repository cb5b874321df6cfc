// Models; what is read is rigged by its own front view.
#include "libskel/mesh/obj.h"
#include "tests/fuzz/rig_checks.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  fileOf("newmtl skin\nmap_Kd none.png\n", "a.mtl");
  mayRefuse([&] {
    RigInput input;
    input.model = readObj(fileOf(textOf(data, size), "fuzz.obj"));
    requireSound(rigCharacter(std::move(input), rigOptions(size)));
  });
  return 0;
}
