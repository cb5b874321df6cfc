// Names in the order in which people read them.
#pragma once

#include <string>

namespace skel {

// Whether numbers in names count as numbers: "a9" before "a10".
bool comesBefore(const std::string& a, const std::string& b);

}  // namespace skel
