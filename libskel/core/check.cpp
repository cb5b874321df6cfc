#include "libskel/core/check.h"

#include <cstdio>
#include <cstdlib>

namespace skel {

void checkFailed(const char* file, int line, const std::string& message) {
  std::fprintf(stderr, "%s:%d: %s\n", file, line, message.c_str());
  std::abort();
}

}  // namespace skel
