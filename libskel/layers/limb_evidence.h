// What speaks for a limb that was found in a drawing: whether its pixels look like an arm or a leg along its
// bones, and what divides them from the rest of the figure.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "libskel/layers/find_parts.h"
#include "libskel/layers/part_net.h"

namespace skel {

// Lengths as shares of the limb's bones or, where it says so, of the figure's long side.
inline constexpr auto kLimbInputs = std::to_array<std::string_view>({
    "leg",
    "animal",
    "area",           // of the figure's
    "stout",          // logarithm of its area over the square of its bones
    "length",         // of the bones, of the figure
    "in one",         // of its area, the largest part
    "off the bones",  // mean distance of its pixels
    "far off",        // 95 in 100 are nearer, of the figure
    "seen above",
    "seen below",
    "seen at the end",  // of points on the upper bone, the lower one, its last half
    "others on bones",  // of points on the bones, those on another part
    "outside",          // or outside of the figure
    "ragged",           // of its area, what a disc of .4 of its width does not reach
    "width",            // median along the bones, of the figure
    "uneven",           // deviation of that, of the median
    "thinnest",         // least beyond the root, of the median
    "border",
    "drawn",  // of its border, what lies against the figure; of that, with a line
    "beside",
    "drawn beside",  // the same beyond its root
    "first quarter",
    "second quarter",
    "third quarter",  // of its area, by where along the bones
    "scraps",         // of the figure, what is cut off from the rest without it
    "sure",
    "before",  // PartPicture
    "root",
    "middle",
    "end",
    "all",                // confidence in its joints, mean of that in all
    "other of the pair",  // logarithm of its area over this one's
});

// Of a limb's border, px.
struct LimbBorder {
  // Of it against the rest of the figure; of that with a line or an edge; the same beyond the limb's root.
  int all = 0, against = 0, drawn = 0, beside = 0, beside_drawn = 0;
};

// Whether the limb lies against the rest of the figure beyond its root, so that it would drag that along if
// it were one with it.
bool liesAgainst(const LimbBorder& border);

// Of the four limbs, by arms first: what arms hold is no border of the legs. `skeleton` in image px, the
// corner of the first px at 0.
std::array<LimbBorder, 4> limbBorders(const PartPicture& picture, const PartSkeleton& skeleton);

// Of points on the limb's bones beyond its root, the share that shows it.
double seenOf(const PartPicture& picture, const PartSkeleton& skeleton, int limb);

// Confidence in the joints of a skeleton, [0, 1].
struct LimbConfidences {
  std::array<std::array<double, 3>, 4> of_limb{};
  double mean = 0;  // of all joints
};

struct LimbEvidence {
  int area = 0;            // px of the picture; 0: nothing of it was found
  Eigen::VectorXd inputs;  // kLimbInputs; empty where nothing was found
};

// `border`: of this limb.
LimbEvidence limbEvidence(const PartPicture& picture, const PartSkeleton& skeleton,
                          const LimbConfidences& confidences, const LimbBorder& border, int limb);

}  // namespace skel
