// Where sprites are seen from.
#pragma once

#include <string>
#include <vector>

#include "animator/sprite_sheet.h"
#include "libskel/draw/render_mesh.h"
#include "libskel/export/write_character.h"

namespace skel {

struct SpriteDirection {
  std::string
      name;  // where the figure looks on a map whose south is the viewer: "s", "sw" …; empty: as drawn
  double yaw_rad = 0;  // of the camera
};

// 1: as it is drawn; 2 (to the left, "w", and to the right, "e"), 4, 8, 16: round about, as a clock goes from
// "s", where the figure looks at the viewer.
std::vector<SpriteDirection> spriteDirections(const RiggedCharacter& character, int count);

// How far a figure reaches in the picture from the point on the ground that it turns about, m.
struct SpriteExtent {
  double aside = 1e-6, low = 0, high = 1e-6;

  SpriteExtent with(const SpriteExtent& other) const;  // what both reach
  SpriteExtent grown(double by_m) const;               // on all sides
};
// Of these points, from all directions. The figure turns about the vertical through the middle of its joints.
SpriteExtent spriteExtent(const RiggedCharacter& character, const Eigen::MatrixX3f& points,
                          const std::vector<SpriteDirection>& directions, double pitch_rad);

// As good as without perspective. The point that the figure turns about is the cell's pivot, on a whole
// pixel. All of the extent is seen, `margin_px` from the border.
struct SpriteCamera {
  SpriteCell cell;
  Camera camera;  // but for its yaw
};
SpriteCamera spriteCamera(const SpriteExtent& extent, double pitch_deg, int width, int height, int margin_px);

// The same for a cell that is given. What reaches beyond it is not seen.
SpriteCamera spriteCamera(const SpriteCell& cell);
// How far that is, px; 0: all is seen.
struct BeyondCell {
  int px = 0;
  const char* where = "";  // where it is farthest, for the user
};
BeyondCell beyondCell(const SpriteExtent& extent, const SpriteCell& cell);

// Of one direction.
Camera turned(const SpriteCamera& camera, const RiggedCharacter& character, double yaw_rad);

}  // namespace skel
