// What is thrown that is no Error of ours: by the standard library, the system, OpenCV.
#pragma once

#include <string>

#include "libskel/core/error.h"

namespace skel {

// The exception that is being handled, to be called in a catch block: an Error as it is, anything else as one
// line that begins with `source`, the file that was worked on. No memory and no thread are kUnavailable, the
// rest is kInput.
Error caughtError(const std::string& source);

}  // namespace skel
