// Motions that travel, for games: there the game moves the figure.
#pragma once

#include "libskel/export/write_character.h"

namespace skel {

// In units of the model's height: who goes no farther than that from where he stands at rest only sways.
inline constexpr double kSway = 0.15;

// The clip, which is relative to the rest pose, with the hips above where they are at rest where it goes
// farther than kSway, else as it is. `way_m`: how far it goes, level.
struct InPlace {
  Clip clip;
  double way_m = 0;
  bool travels = false;
};
InPlace inPlace(const Clip& clip, const RiggedCharacter& character);

}  // namespace skel
