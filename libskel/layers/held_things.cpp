#include "libskel/layers/held_things.h"

#include <array>
#include <cstdint>
#include <vector>

#include "libskel/image/mask_parts.h"

namespace skel {
namespace {

constexpr double kLeastThing = .004;  // of the figure's pixels

}  // namespace

void giveThingsToLimbs(const Silhouette& silhouette, LayerMap& map) {
  if (!map.any() || map.part.size() == 0) return;
  const auto thing = static_cast<std::uint8_t>(Part::kThing);
  const MaskParts things = maskParts((map.part == thing && silhouette.mask != 0).cast<std::uint8_t>());
  const double least = kLeastThing * static_cast<double>((silhouette.mask != 0).count());
  const auto rows = map.limb.rows(), columns = map.limb.cols();
  std::vector<std::array<int, 256>> border(things.size.size(), std::array<int, 256>{});
  const auto touch = [&](int part, Eigen::Index y, Eigen::Index x) {
    if (y >= 0 && x >= 0 && y < rows && x < columns && silhouette.mask(y, x) != 0 && map.part(y, x) != thing)
      ++border[static_cast<std::size_t>(part)][map.limb(y, x)];
  };
  for (const MaskParts::Run& run : things.runs) {
    touch(run.part, run.y, run.x0 - 1), touch(run.part, run.y, run.x1);
    for (int x = run.x0; x < run.x1; ++x) touch(run.part, run.y - 1, x), touch(run.part, run.y + 1, x);
  }
  for (const MaskParts::Run& run : things.runs) {
    if (static_cast<double>(things.size[static_cast<std::size_t>(run.part)]) < least) continue;
    const std::array<int, 256>& of = border[static_cast<std::size_t>(run.part)];
    int all = 0;
    for (const int px : of) all += px;
    for (int limb = 1; limb < 256; ++limb)
      if (2 * of[static_cast<std::size_t>(limb)] > all)
        map.limb.row(run.y).segment(run.x0, run.x1 - run.x0).setConstant(static_cast<std::uint8_t>(limb));
  }
}

}  // namespace skel
