// Pictures that are named by a number: frames of a film, its key frames.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "libskel/image/image.h"

namespace skel {

// A PNG that says in its "Software" that it is skel's.
std::string encodeFrame(const Image& frame);

// Before frames are written into `dir`: <prefix>0001.png and so on. Those that are there are outputs from now
// on (input_guard.h). Returns their names, sorted. Throws OutputError if one is not skel's own, so that
// somebody else's pictures of such names stay.
std::vector<std::string> checkFrames(const std::string& dir, const std::string& prefix);

// Of frames that are there those that `known` does not name: they would be taken for frames of the new film.
// Throws OutputError.
void refuseOtherFrames(const std::string& dir, const std::vector<std::string>& there,
                       const std::set<std::string>& known);

}  // namespace skel
