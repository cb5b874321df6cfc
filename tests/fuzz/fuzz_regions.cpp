// Tables of the parts of a body; what is read sorts a figure's joints.
#include "libskel/skin/regions.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/figure.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skel;
  static const Skeleton skeleton = figureSkeleton();
  mayRefuse([&] {
    const SkinRegions regions = parseRegions(textOf(data, size), "fuzz.regions.json");
    for (const int region : regions.ofJoints(skeleton))
      require(region >= 0 && region < static_cast<int>(regions.regions.size()), "each joint has a region");
    for (const SkinRegion& region : regions.regions)
      for (const int other : region.mixes)
        require(other >= 0 && other < static_cast<int>(regions.regions.size()), "regions mix with regions");
  });
  return 0;
}
