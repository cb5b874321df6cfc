// Pictures that are named by a number: frames of a film, its key frames.
#pragma once

#include <string>

#include "libskel/image/image.h"

namespace skel {

// A PNG that says in its "Software" that it is skel's.
std::string encodeFrame(const Image& frame);

// Before frames are written into `dir`: <prefix>0001.png and so on. Those that are there are outputs from now
// on (input_guard.h). Throws OutputError if one is not skel's own, so that somebody else's pictures of such
// names stay.
void checkFrames(const std::string& dir, const std::string& prefix);

}  // namespace skel
