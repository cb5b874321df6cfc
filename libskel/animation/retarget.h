// Clips made for the canonical pose, for a character that was drawn in any other.
#pragma once

#include <optional>

#include "libskel/animation/clip.h"
#include "libskel/animation/figure_shape.h"

namespace skel {

struct RetargetOptions {
  float rate_hz = 30;         // most keys a second of the result, more than 0; fewer where that shows nowhere
  bool clear_of_head = true;  // raised arms that would pass through the head swing out until they do not
  // Limbs that point at the viewer are stumps in the picture. So much of that way turns into the picture, of
  // a figure in front view: 0 nothing, 1 all of it. By eye on 29 drawings (0, .4 and .8 in hidden order; no
  // difference on 9), .4 was the best of 14 and the worst of 1, 0 the best of 1 and the worst of 12.
  double into_picture = .4;
  // What a body does by itself (ClipFrame::kBody) comes towards the viewer, each limb turned to its own side;
  // with this, limbs turn to the side that the figure rather looks to, as if they were seen aslant, but for
  // arms, or legs, that rather move in the picture than towards the viewer.
  bool aslant = false;
  bool thin_keys = true;                            // where `rate_hz` is more than shows
  std::optional<FigureShape> shape = std::nullopt;  // nothing: shapeOfBones()
};

// The clip as rotations relative to the skeleton's rest pose (Skeleton::joints' positions). Tracks with a
// bone make the drawn bone point where the canonical one would, relative to the trunk; tracks without one are
// added to the drawn pose; joints without a track keep the drawn pose. Limbs are taken out of the drawn pose
// by the way round the outside of the body, never through it, and arms that are folded or on the hips stay
// there. Feet that stand, stay (plant_feet.h). A clip whose rest pose this is stays as it is. Throws
// UsageError if the clip moves a joint that the skeleton lacks, or clip, skeleton or options are none
// (check_clip.h, check_skeleton.h), Error (refused input) if it puts a joint on the ground that is no foot,
// or is too long.
Clip retargetToRest(const Clip& clip, const Skeleton& skeleton, const RetargetOptions& options = {});

}  // namespace skel
