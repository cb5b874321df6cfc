// The character files of AnimatedDrawings.
#include "labeler/char_cfg.h"
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  mayRefuse([&] {
    const CharCfg cfg = parseCharCfg(textOf(data, size), "char_cfg.yaml");
    require(cfg.width > 0 && cfg.height > 0 && !cfg.joints.empty(), "it has a size and joints");
    for (const auto& [name, place] : cfg.joints)
      require(!name.empty() && place.allFinite(), "joints have names and places");
  });
  return 0;
}
