// One of the closed bodies that a layered figure is made of.
#pragma once

#include "libskel/image/image.h"

namespace skel {

struct FigurePiece {
  int layer = 0;  // 0: trunk and head; else the limb, numbered from 1 in the template's order
  Plane8 mask;    // of the image's size, not 0 on the piece, also where others hide it; 4-connected
  Plane8 hidden;  // of the image's size, not 0 where the drawing shows something else in its place
  Plane8 over;    // of the image's size, not 0 where it must lie before the pieces that come before it
};

}  // namespace skel
