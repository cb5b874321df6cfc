// The character file of AnimatedDrawings (Meta, MIT licence), char_cfg.yaml: size of the picture, and a
// skeleton as a list of joints with loc, name and parent.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace skel {

struct CharCfg {
  int width = 0, height = 0;                                    // of texture.png, px
  std::vector<std::pair<std::string, Eigen::Vector2d>> joints;  // in the file's order, image px
  // What skel-infer says of its own: joints that lie where it has found them, and the hash of the mask that
  // it has found.
  std::vector<std::string> found;
  std::string found_mask_sha256;
};

// Reads the part of YAML that such files use: block mappings and lists by indentation, [x, y] in one line,
// quoted words, comments. Throws InputError with the line.
CharCfg parseCharCfg(std::string_view text, const std::string& file);

// Their names for our joints, as pairs (theirs, ours): what they call neck is the point of the face, what
// they call torso lies between the shoulders, root and hip between the hips.
const std::vector<std::pair<std::string, std::string>>& charCfgJointNames();

}  // namespace skel
