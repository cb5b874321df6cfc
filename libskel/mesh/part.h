// The parts that a drawn figure is made of.
#pragma once

#include <cstdint>

namespace skel {

enum class Part : std::uint8_t {
  kTrunk,
  kHead,
  kHair,      // or a beard, where it hangs below the chin
  kRightArm,  // or front leg
  kLeftArm,
  kRightLeg,  // or hind leg
  kLeftLeg,
  kSkirt,     // or the tails of a coat
  kAppendix,  // cape, wing, tail
  kThing,     // held or worn
};
inline constexpr int kPartCount = 10;
// The part that is limb 0…3 of a body plan.
inline constexpr Part limbPart(int limb) {
  return static_cast<Part>(static_cast<int>(Part::kRightArm) + limb);
}

}  // namespace skel
