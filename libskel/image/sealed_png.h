// Pictures that programs write and people paint in: whether somebody has.
#pragma once

#include <string>
#include <string_view>

#include "libskel/image/image.h"

namespace skel {

// As encodePng(), with a hash of the pixels as a text (tEXt, "skel-pixels").
std::string encodeSealedPng(const Image& image);
std::string encodeSealedPng(const Plane8& plane);

// Whether such a picture still has the pixels that it was written with. False of any other bytes: programs
// for painting leave out texts that they do not know.
bool isAsSealed(std::string_view bytes);

}  // namespace skel
