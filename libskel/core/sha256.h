// SHA-256 (FIPS 180-4), to tell whether a file is still the one that was labelled.
#pragma once

#include <string>
#include <string_view>

namespace skel {

// 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace skel
