// Pictures that a program has made itself.
#pragma once

#include <string>

#include "libskel/image/image.h"

namespace skel {

// "600x400".
std::string sizeInPx(Eigen::Index width, Eigen::Index height);

// Throws UsageError that begins with `name` unless `rgba` has a row for each of width·height pixels. No pixel
// is looked at.
void checkImage(const Image& image, const std::string& name);

// Throws UsageError unless the plane has the image's size: "`name` is of 10x10 px, `image_name` has 600x600".
void checkPlaneOf(const Plane8& plane, const std::string& name, const Image& image,
                  const std::string& image_name);

}  // namespace skel
