// Which moment of one motion is which of another.
//
// Dynamic time warping: H. Sakoe, S. Chiba, "Dynamic programming algorithm optimization for spoken word
// recognition" (1978); for motions that loop, on a circle, from whichever frame is best.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "libskel/style/poses.h"

namespace skel {

// On a circle, so many beginnings are tried at most.
inline constexpr int kPhaseBeginnings = 60;

struct PhaseOptions {
  bool content_loops = false, style_loops = false;
  std::string content_path = "the content", style_path = "the style";  // for complaints
  std::function<void()> on_beginning = {};                             // after each; may be empty
};

struct PhaseAlignment {
  // Of each frame of the content, the moment of the style, in frames; in [0, m), with m the style's frames.
  // Between its last frame and its first, where the style loops.
  std::vector<double> style_frame;
  double cost = 0;  // mean squared difference of the compared poses, 2 for those that have nothing in common
};

// Poses are compared after the mean pose has been taken away from each motion, and in units of its own
// spread: how a figure holds itself and how far it swings does not matter, when it swings does. Canonical
// poses, at least one frame each, the same number of rows. Throws InputError that names both paths:
// more than 16 million frames of the one times those of the other; a style that loops and is so long beside a
// cycle of the content that too many of its frames pass at each step.
PhaseAlignment alignPhases(const PoseMatrix& content, const PoseMatrix& style, const PhaseOptions& options);

// The poses at such moments: straight between frames.
PoseMatrix posesAt(const PoseMatrix& poses, const std::vector<double>& frames, bool loops);

}  // namespace skel
