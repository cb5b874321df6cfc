// What speaks for and against joints that were found: what ConfidenceModel is asked about. It knows joints by
// their place in the body plan alone, so that it is the same for people and animals.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>
#include <vector>

#include "libskel/image/image.h"
#include "libskel/jointnet/joint_net.h"
#include "libskel/jointnet/net_joints.h"
#include "libskel/jointnet/tree_recognizer.h"
#include "libskel/skeleton/template.h"

namespace skel {

// Masses are log-odds, z how many deviations a bone's length differs from others of its kind (BoneLength),
// lengths are relative to the figure's long side.
inline constexpr auto kJointInputs = std::to_array<std::string_view>({
    "mass", "rival", "counterpart", "entropy", "likelihood", "disagreement",  // TreeJoint
    "length z", "|length z|", "|proportion z|", "outside",                    // of the bone that leads there
    "thickness",                   // log of the distance to the outline, to the body joint's
    "apart",                       // from the same joint of the other side; of the middle .5
    "mass before", "mass behind",  // of the joints that bones lead to from here; its own where there is none
    "figure", "mean entropy", "turned", "uncovered", "farthest", "from side",     // of the whole
                                                                                  // figure
    "head", "body", "other", "shoulder", "elbow", "hand", "hip", "knee", "foot",  // 1: it is such a joint
});

inline constexpr auto kFigureInputs = std::to_array<std::string_view>({
    "figure", "mean entropy", "turned", "from side",  // TreeRecognition, SkeletonTemplate
    "uncovered", "farthest",                          // BoneCoverage
    "least mass", "mean mass", "most disagreement", "mean disagreement", "most |z|", "mean |z|",
    "most outside", "mean outside", "most unlike",
    "mean unlike",  // bones of the two sides: the logarithm of one's length to the other's
    "filled",       // share of the figure's box
    "upright",      // log of the box's height to its width
});

// Of joints without a tail's, whose absence is no fault. J×kJointInputs and kFigureInputs numbers, all
// finite.
struct Evidence {
  Eigen::ArrayXXd joints;
  Eigen::ArrayXd figure;
  std::vector<bool> counts;  // by joint: of a limb, the head or the body
};

// `mask` is that of the working grid in which `found` was found.
Evidence evidenceOf(const TreeRecognition& found, const Plane8& mask, const JointNet& net,
                    const NetJoints& joints, const SkeletonTemplate& body_plan);

}  // namespace skel
