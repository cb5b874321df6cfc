// Checks for a caller's bugs (not for a user's data: see error.h). On in every build; a failure prints both
// values and aborts.
#pragma once

#include <sstream>
#include <string>

namespace skel {

[[noreturn]] void checkFailed(const char* file, int line, const std::string& message);

}  // namespace skel

#define SKEL_CHECK(condition)                                                          \
  do {                                                                                 \
    if (!(condition)) ::skel::checkFailed(__FILE__, __LINE__, "expected " #condition); \
  } while (false)

#define SKEL_CHECK_EQ(a, b)                                                          \
  do {                                                                               \
    const auto& skel_a_ = (a);                                                       \
    const auto& skel_b_ = (b);                                                       \
    if (!(skel_a_ == skel_b_)) {                                                     \
      std::ostringstream skel_s_;                                                    \
      skel_s_ << "expected " #a " == " #b ", got " << skel_a_ << " and " << skel_b_; \
      ::skel::checkFailed(__FILE__, __LINE__, skel_s_.str());                        \
    }                                                                                \
  } while (false)
