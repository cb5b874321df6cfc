// Files of kinds that skel does not read.
#pragma once

#include <string>

namespace skel {

// What this is and what to convert it with, to stand behind its name: "is an SVG drawing; convert it by
// `rsvg-convert …`". By the ending of the name; empty: nothing is known of it.
std::string howToConvert(const std::string& path);

}  // namespace skel
