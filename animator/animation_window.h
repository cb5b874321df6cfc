// The window of skel-animate: a thin layer over AnimationDocument.
#pragma once

#include "animator/load_character.h"
#include "libskel/core/error.h"

namespace skel {

// Opens a character in a window and returns when it is closed. Throws InputError, and
// UnavailableError where there is no display or skel was built without windows.
ExitCode runAnimationWindow(const CharacterSource& source, const ClipSource& clips);

}  // namespace skel
