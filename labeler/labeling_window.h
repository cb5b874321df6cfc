// The window of skel-label: a thin layer over Document.
#pragma once

#include <string>

#include "labeler/document.h"
#include "libskel/core/error.h"

namespace skel {

// Opens `path` (see Document) in a window and returns when it is closed. Throws InputError, and
// UnavailableError where there is no display or skel was built without windows.
ExitCode runLabelingWindow(const std::string& path, DocumentOptions options);

}  // namespace skel
