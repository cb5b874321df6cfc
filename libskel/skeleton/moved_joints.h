// Joints that a person has moved, without a word about it, in a skeleton file that does not say where they
// were.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace skel {

// One affine map takes all joints of a file that skel wrote from the drawing into the model. Returns the
// indices of those that the map of most of the others does not take from `image` (px) to `position` (m; x and
// y), by more than half a pixel; ascending. Nothing where the positions are not known yet (all in one place),
// or of fewer than five joints. M. Fischler, R. Bolles, "Random sample consensus" (1981), with every sample
// of up to a hundred joints tried, and of more as many as take as long, at random but always the same.
std::vector<int> movedJoints(const std::vector<Eigen::Vector2d>& image,
                             const std::vector<Eigen::Vector2d>& position);

}  // namespace skel
