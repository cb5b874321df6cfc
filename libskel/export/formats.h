// The formats that a character is written in, by name. Another format is one file and one line in
// formats.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "libskel/export/write_character.h"

namespace skel {

// What a format may draw on.
struct ExportInput {
  const RiggedCharacter& character;
  const std::vector<Clip>& clips;  // retargeted to the character's rest pose
  ExportOptions options;           // name: the files' stem, as files name each other by it
  const Image* drawing = nullptr;  // Joint::image is in its px
  const Plane8* mask = nullptr;    // of the drawing's size, 255 on the figure
  bool mask_is_given = false;      // by a person; else it was found
};

struct ExportedFile {
  std::string suffix;  // to be put behind the stem: ".glb", "/mask.png"
  std::string bytes;
};

struct ExportFormat {
  std::string_view name;
  // At least those of the files that encode() gives for these clips, a cheap answer before any work. Throws
  // UsageError where files cannot have this stem.
  std::vector<std::string> (*suffixes)(const std::string& stem, const std::vector<Clip>& clips);
  std::vector<ExportedFile> (*encode)(const ExportInput&);
};

const std::vector<ExportFormat>& exportFormats();

// Throws UsageError that lists the names there are.
const ExportFormat& exportFormat(std::string_view name);

// glb: see encodeGlb().
std::vector<ExportedFile> exportGlb(const ExportInput& input);
// obj: the mesh with normals, and its texture, as .obj, .mtl and .png. Throws UsageError where OBJ and MTL
// cannot name these (objSuffixes() as well).
std::vector<ExportedFile> exportObj(const ExportInput& input);
std::vector<std::string> objSuffixes(const std::string& stem, const std::vector<Clip>& clips);
// weights: the skin as .weights.json, vertices in the order of the .obj and the .glb.
std::vector<ExportedFile> exportWeights(const ExportInput& input);
// bvh: hierarchy and motion, one file a clip (-<clip>.bvh), or the rest pose if there is none (.bvh).
// Centimetres, degrees, y up.
std::vector<ExportedFile> exportBvh(const ExportInput& input);
std::vector<std::string> bvhSuffixes(const std::string& stem, const std::vector<Clip>& clips);
// char_cfg: a folder as AnimatedDrawings reads it, with char_cfg.yaml, mask.png and texture.png. Throws
// UsageError without drawing and mask, or if the skeleton is not a biped.
std::vector<ExportedFile> exportCharCfg(const ExportInput& input);

}  // namespace skel
