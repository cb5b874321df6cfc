// What is thrown that is no Error of ours: by the standard library, the system, OpenCV.
#pragma once

#include <string>

#include "libskel/core/error.h"

namespace skel {

// The exception that is being handled, to be called in a catch block: an Error as it is, anything else as one
// line that begins with `source`, the file that was worked on. No memory and no thread are kUnavailable, the
// rest is kInput.
Error caughtError(const std::string& source);

// What `work()` returns; whatever it throws leaves as an Error.
template <typename Work>
auto throwingErrors(const std::string& source, const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (...) {
    throw caughtError(source);
  }
}

}  // namespace skel
