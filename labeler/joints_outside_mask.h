// Joints that lie beside the mask: it is inverted then, or shows another figure or a part of this one.
#pragma once

#include <string>

#include "libskel/labels/label_file.h"
#include "libskel/skeleton/template.h"

namespace skel {

// "9 of 14 joints lie outside the mask a.mask.png"; "" where it is one or two, or a third of them or less.
// Joints that follow from others do not count. Throws InputError: the mask cannot be read.
std::string jointsOutsideMask(const LabelFile& labels, const SkeletonTemplate& body_plan,
                              const std::string& mask_path);

}  // namespace skel
