// One of the closed bodies that a layered figure is made of.
#pragma once

#include "libskel/image/image.h"
#include "libskel/mesh/outline.h"

namespace skel {

struct FigurePiece {
  int layer = 0;        // 0: trunk and head; else the limb, numbered from 1 in the template's order
  PixelBox box;         // of the image; all planes have its size
  Plane8 mask;          // not 0 on the piece, also where others hide it; 4-connected
  Plane8 hidden;        // not 0 where the drawing shows something else in its place
  Plane8 over;          // not 0 where it must lie before the pieces that come before it
  bool behind = false;  // the trunk: it lies over nothing
  double root_px = 0;   // of a limb: half of its width, below where it hangs on the trunk
};

}  // namespace skel
