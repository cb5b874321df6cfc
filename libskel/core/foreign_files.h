// Files of kinds that skel does not read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace skel {

// What this is and what to convert it with, into a file beside it, to stand behind its name: "is an SVG
// drawing; convert it by `rsvg-convert …`". By the ending of the name; empty: nothing is known of it.
std::string howToConvert(const std::string& path);
// By what is in it, whatever its name: `ending` is that of such files (".heic").
std::string howToConvert(const std::string& path, std::string_view ending);

// Takes those out of `pictures` that skel does not read and of which one that it reads is among them, under
// the same name but for the ending: a photo that was converted, or that the telephone has stored twice.
void passOverConverted(std::vector<std::string>& pictures);

}  // namespace skel
