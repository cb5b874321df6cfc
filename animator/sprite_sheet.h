// Many small pictures in one large one, for games.
#pragma once

#include <string>
#include <vector>

#include "libskel/image/image.h"

namespace skel {

struct Sprite {
  std::string name;
  int duration_ms = 0;
  Image image;  // a whole cell
};

// Sprites one behind the other that are one motion from one side.
struct SpriteTag {
  std::string name;
  int first = 0, last = 0;  // both included
  bool loops = true;        // else it is played once
};

// What all sprites share.
struct SpriteCell {
  int width = 0, height = 0;           // px
  int pivot_x = 0, pivot_y = 0;        // px from the left and from the top: below the figure, on the ground
  double px_per_m = 0, pitch_deg = 0;  // how large figures are, and from how far above they are seen
  double angle_deg = 0;                // that all sides are turned by
};

struct Box {
  int x = 0, y = 0, width = 0, height = 0;  // px
};

struct PlacedSprite {
  Box in_sheet, in_cell;  // of the same size
};

struct SpriteSheet {
  Image picture;
  std::vector<PlacedSprite> placed;  // one a sprite
};

enum class SpritePacking {
  kEven,     // whole cells; each tag begins a row
  kTrimmed,  // what is not clear of each, a pixel apart
};

// What can be said before there are sprites. Throws UsageError: the sheet would be longer than
// kLongestSheet_px, a cell than kLongestCell_px, or there would be more than kMostSprites.
void checkSheetSize(const std::vector<SpriteTag>& tags, const SpriteCell& cell, SpritePacking packing);

// Throws UsageError as above.
SpriteSheet packSprites(const std::vector<Sprite>& sprites, const std::vector<SpriteTag>& tags,
                        const SpriteCell& cell, SpritePacking packing);

// What graphics cards of ten years take.
inline constexpr int kLongestSheet_px = 16384, kLongestCell_px = 2048;
// 1024 rows of 16: who lists them by name looks for each among all.
inline constexpr int kMostSprites = 16384;

}  // namespace skel
