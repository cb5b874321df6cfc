// Films among pictures.
#pragma once

#include <string>

namespace skel {

// Whether a file is a GIF or WebP of more than one frame. False where it cannot be read.
bool isAnimatedPicture(const std::string& path);

}  // namespace skel
