// Where a model looks: one that was drawn from the side looks to that side.
#pragma once

#include <string>

#include "libskel/export/write_character.h"

namespace skel {

// About the vertical, rad, in [-pi, pi]: 0 to the viewer (+z), positive to +x, as far as skel can tell.
double facing(const RiggedCharacter& character);

// For the user: "from the front", "looking left".
std::string drawnFrom(double facing_rad);

}  // namespace skel
