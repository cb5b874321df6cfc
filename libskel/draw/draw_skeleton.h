// `<stem>.overlay.png`: a drawing with its skeleton.
#pragma once

#include "libskel/draw/canvas.h"
#include "libskel/skeleton/skeleton.h"

namespace skel {

struct SkeletonStyle {
  double bone_px = 0;           // width of a bone; 0: to suit the skeleton's extent
  double low_confidence = 0.5;  // joints below it are drawn hollow
};

// Bones and joints at Joint::image: blue on the character's left, orange on its right, violet between.
void drawSkeleton(Image& image, const Skeleton& skeleton, const SkeletonStyle& style = {});

}  // namespace skel
