// The window of skel-animate: a thin layer over AnimationDocument.
#pragma once

#include <string>

#include "libskel/core/error.h"

namespace skel {

// Opens `path` (see AnimationDocument) in a window and returns when it is closed. Throws InputError, and
// UnavailableError where there is no display or skel was built without windows.
ExitCode runAnimationWindow(const std::string& path, const std::string& body_plan);

}  // namespace skel
