// Models that skel-animate writes.
#pragma once

#include <string>

namespace skel {

// Who wrote them, in the file itself.
inline constexpr const char *kWrittenByView = "skel-animate view", *kWrittenByBind = "skel-animate bind",
                            *kWrittenByRetarget = "skel-animate retarget";

// Where a model goes that nobody gave a name for: out/<name of `source`>.glb. Throws UsageError if a file
// lies there that `writer` has not written.
std::string glbNamedAfter(const std::string& source, const std::string& writer);

}  // namespace skel
