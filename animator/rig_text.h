// A skeleton as a file that readRigFile() (libskel/skeleton/rig_file.h) and other programs read.
#pragma once

#include <string>
#include <vector>

#include "libskel/skeleton/skeleton.h"

namespace skel {

// Positions in the model frame, y up; each joint's tail is its child's head, or the middle of its children's.
std::string formatRig(const Skeleton& skeleton);

// From joint to joint: of the joints that hang on another.
int boneCount(const Skeleton& skeleton);

// A line of a list that shows the hierarchy.
struct TreeLine {
  std::size_t joint;
  std::string spaces;  // two a level, no more than a line has room for
};
// All joints, each below the one that carries it, whatever their order in the skeleton.
std::vector<TreeLine> asTree(const Skeleton& skeleton);

}  // namespace skel
