// Biovision Hierarchy: a skeleton and its motion as text (Meredith & Maddock, "Motion Capture File Formats
// Explained", 2001). Written by exportBvh().
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "libskel/animation/clip.h"

namespace skel {

struct BvhMotion {
  // Its joints, as the file's offsets place them; lengths and axes are the file's. All are unturned then.
  Skeleton skeleton;
  std::vector<Eigen::Vector3d> tips;  // one a joint: where its End Site is, from the joint; zero: it has none
  // A key a frame for every joint; translations, of joints with position channels, in the file's lengths:
  // what is added to the offset.
  Clip clip;
};

// `file` is the name that complaints use. Throws InputError with the line: what is no hierarchy, channels
// that do not exist, two joints of one name, fewer or more numbers than the channels ask for, NaN.
BvhMotion parseBvh(std::string_view text, const std::string& file);
// The clip gets the file's stem as its name.
BvhMotion readBvh(const std::string& path);

}  // namespace skel
