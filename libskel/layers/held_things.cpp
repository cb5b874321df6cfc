#include "libskel/layers/held_things.h"

#include <array>
#include <cstdint>
#include <numeric>
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
  std::vector<std::uint8_t> owner(things.size.size(), 0);  // a limb, or none
  for (std::size_t part = 0; part < owner.size(); ++part) {
    if (static_cast<double>(things.size[part]) < least) continue;
    const int all = std::accumulate(border[part].begin(), border[part].end(), 0);
    for (std::size_t limb = 1; limb < border[part].size(); ++limb)
      if (2 * border[part][limb] > all) owner[part] = static_cast<std::uint8_t>(limb);
  }
  for (const MaskParts::Run& run : things.runs)
    if (const std::uint8_t limb = owner[static_cast<std::size_t>(run.part)]; limb != 0)
      map.limb.row(run.y).segment(run.x0, run.x1 - run.x0).setConstant(limb);
}

}  // namespace skel
