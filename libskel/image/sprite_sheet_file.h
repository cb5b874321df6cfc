// Sheets of sprites that skel-animate has made.
#pragma once

#include <string>

namespace skel {

// What the atlas of such a sheet says that it is by.
inline constexpr const char* kAtlasApp = "skel-animate";

// Whether a .json is the atlas of one.
bool isAtlas(const std::string& path);

// The atlas beside a picture that is its sheet (sheet.json beside sheet.png); "": the picture is none.
std::string atlasBeside(const std::string& picture);

}  // namespace skel
