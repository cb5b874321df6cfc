// What skel-infer was unsure of when it last rigged a drawing.
#pragma once

#include <string>
#include <vector>

#include "labeler/drawing_list.h"

namespace skel {

// The warnings of the skeleton file that was found in this very picture, beside it, in out/ beside it or in
// out/ of the working directory (mend_places.h). Nothing where there is none, or one that cannot be read, or
// the drawing was mended since.
std::vector<std::string> doubtsOf(const DrawingFiles& files);

}  // namespace skel
