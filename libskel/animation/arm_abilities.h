// What a figure's arms can do of a clip: some are one piece with the body, folded, or stumps.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "libskel/animation/clip.h"
#include "libskel/animation/figure_shape.h"

namespace skel {

// What the figure's arms do not do of the clips that are for the canonical pose, for the user: one clause for
// all clips of which the same is to be said.
std::vector<std::string> armsThatStay(std::span<const Clip> clips, const Skeleton& skeleton,
                                      const FigureShape& shape);

// Of arms, sides are "left_" and "right_".

// How far the arm stays as it was drawn, 0…1; 0 where there is none.
double keptArm(const Skeleton& skeleton, const FigureShape& shape, const std::string& side);
// How much of its motion is left to a joint that keeps the share `kept` of how it was drawn.
double heldShare(double kept);

// How far the joints go in the clip, rad, all together, if those that may stay where they were drawn
// (JointTrack::slack_rad) go this share of it.
double travelOf(const Clip& clip, const std::set<std::string>& joints, double held_share = 1);
double armTravel(const Clip& clip, const std::string& side, double held_share = 1);

// A clip that is one arm's, for a figure whose arm does not show it: by the other, if that shows it better,
// or, if neither shows it, by the trunk.
Clip asItCan(const Clip& clip, const Skeleton& skeleton, const FigureShape& shape);

}  // namespace skel
