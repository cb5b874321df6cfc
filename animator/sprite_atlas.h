// Where the sprites of a sheet are, as JSON that programs for games read.
#pragma once

#include <string>
#include <vector>

#include "animator/sprite_sheet.h"

namespace skel {

enum class AtlasForm {
  kArray,     // "frames" is a list with file names
  kHash,      // an object: name to frame
  kAseprite,  // the same with numbers for names, which Phaser's createFromAseprite() wants
};

// Of TexturePacker (pivots as shares of the cell) and Aseprite (durations, tags, a slice with the pivot) at
// once. `picture` is the sheet's name as seen from the atlas.
std::string formatAtlas(const std::vector<Sprite>& sprites, const std::vector<SpriteTag>& tags,
                        const SpriteCell& cell, const SpriteSheet& sheet, AtlasForm form,
                        const std::string& picture);

// What the sprites of an atlas share. Throws InputError: not of skel, or without a scale, as skel wrote them
// before.
SpriteCell readSpriteCell(const std::string& path);

}  // namespace skel
