// Which parts of a body may share vertices: the table behind the method idw-region.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "libskel/skeleton/skeleton.h"

namespace skel {

struct SkinRegion {
  std::string name;
  // One of them in a joint's name, between capitals, digits and signs: "arm" is in "L_ForeArm2", not in
  // "forearm". Small letters; empty: all joints that no other region has.
  std::vector<std::string> words;
  std::vector<int> mixes;  // regions whose bones may share a vertex of this one, itself included
  bool own_chain = false;  // of regions that are on limbs too, only bones above or below the vertex's own
  bool rigid = false;      // a vertex goes with its nearest bone alone
  double power = 2;        // of the distances' falloff; less is softer
};

// In the order in which a joint's name, and two bones equally near to a vertex, are decided.
struct SkinRegions {
  std::vector<SkinRegion> regions;

  // Of each joint of the skeleton.
  std::vector<int> ofJoints(const Skeleton& skeleton) const;
};

// A file of the format "skel-regions" (docs/formats.md). Throws InputError: a mix with a region that there is
// not, none or two regions for all other joints.
SkinRegions readRegions(const std::string& path);
SkinRegions parseRegions(std::string_view text, const std::string& file);
// libskel/skin/regions.json.
const SkinRegions& defaultRegions();

}  // namespace skel
