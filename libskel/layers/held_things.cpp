#include "libskel/layers/held_things.h"

#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include "libskel/image/mask_parts.h"

namespace skel {
namespace {

constexpr double kLeastThing = .004;  // of the figure's pixels
constexpr double kAlone = .9;         // of what lies beside a part

constexpr auto kThing = static_cast<std::uint8_t>(Part::kThing),
               kAppendix = static_cast<std::uint8_t>(Part::kAppendix);

int sumOf(const std::array<int, 256>& counts) { return std::accumulate(counts.begin(), counts.end(), 0); }

}  // namespace

void completeThings(const Plane8& mask, Plane8& part) {
  const MaskParts things = maskParts((part == kThing && mask != 0).cast<std::uint8_t>());
  if (things.size.empty()) return;
  const MaskParts found = maskParts((part == kAppendix && mask != 0).cast<std::uint8_t>());
  const std::vector<std::array<int, 256>> border = valuesBeside(found, mask, part);
  const std::int64_t largest = things.size[static_cast<std::size_t>(things.largest())];
  for (const MaskParts::Run& run : found.runs) {
    const auto number = static_cast<std::size_t>(run.part);
    const std::array<int, 256>& beside = border[number];
    if (found.size[number] < largest && beside[kThing] > 0 && beside[kThing] >= kAlone * sumOf(beside))
      part.row(run.y).segment(run.x0, run.x1 - run.x0).setConstant(kThing);
  }
}

void giveThingsToLimbs(const Silhouette& silhouette, LayerMap& map) {
  if (!map.any() || map.part.size() == 0) return;
  const MaskParts things = maskParts((map.part == kThing && silhouette.mask != 0).cast<std::uint8_t>());
  const double least = kLeastThing * static_cast<double>((silhouette.mask != 0).count());
  const std::vector<std::array<int, 256>> border = valuesBeside(things, silhouette.mask, map.limb);
  std::vector<std::uint8_t> owner(things.size.size(), 0);  // a limb, or none
  for (std::size_t part = 0; part < owner.size(); ++part) {
    if (static_cast<double>(things.size[part]) < least) continue;
    const int all = sumOf(border[part]);
    for (std::size_t limb = 1; limb < border[part].size(); ++limb)
      if (2 * border[part][limb] > all) owner[part] = static_cast<std::uint8_t>(limb);
  }
  for (const MaskParts::Run& run : things.runs)
    if (const std::uint8_t limb = owner[static_cast<std::size_t>(run.part)]; limb != 0)
      map.limb.row(run.y).segment(run.x0, run.x1 - run.x0).setConstant(limb);
}

}  // namespace skel
