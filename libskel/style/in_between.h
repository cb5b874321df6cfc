// Frames between key frames.
//
// Patent CN102231209A, equations 5 and 6.
#pragma once

#include <vector>

#include "libskel/style/poses.h"

namespace skel {

// `source`: all frames of a motion, 2J×m. `keys`: ascending frames of it, at least one. `key_poses`: what
// became of those, 2J×|keys|. A point p of a frame between the keys a and b moves as the source moves it,
//   p' = (1 − w)·(a' + p − a) + w·(b' + p − b),  w = |p − a| / (|p − a| + |p − b|),
// with a, b, p its places in the source and a', b' those in the key poses, and so is at a' in the key frame a
// itself. Where it does not move at all in the source, w is the share of the time. Before the first key and
// after the last, or between these two where `loops`, it moves with the one that there is.
PoseMatrix inBetweens(const PoseMatrix& source, const std::vector<int>& keys, const PoseMatrix& key_poses,
                      bool loops);

}  // namespace skel
