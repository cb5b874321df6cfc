// What tells which way a two-legged figure looks: where its joints lie, and how far head, trunk and feet
// reach beside them. Looked at from the front (+z), relative to the trunk's length or the figure's height.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>

#include "libskel/silhouette/silhouette.h"
#include "libskel/skeleton/skeleton.h"

namespace skel {

// Of a figure's mirror image they are the same with the other sign. x is counted from the pelvis.
inline constexpr auto kSidedInputs = std::to_array<std::string_view>({
    "x body",         "x neck",         "x head",         "x head top",  //
    "nape",                                                              // from the neck to the head
    "x shoulders",    "x elbows",       "x hands",        "x hips",
    "x knees",        "x feet",          // sums of both sides
    "bend of knees",  "bend of elbows",  // off the line between their ends
    "reach of feet",                     // to the right less to the left
    "reach of head",  "reach of neck",  "reach of body",  "reach of pelvis",  //
    "middle of head", "middle of neck", "middle of body", "middle of pelvis"  // of what lies nearest
});

// Of a figure's mirror image they are the same.
inline constexpr auto kUnsidedInputs = std::to_array<std::string_view>({
    "y body",
    "y neck",
    "y head",
    "y head top",  //
    "y shoulders",
    "y elbows",
    "y hands",
    "y hips",
    "y knees",
    "y feet",  // sums of both sides
    "apart shoulders",
    "apart elbows",
    "apart hands",
    "apart hips",
    "apart knees",
    "apart feet",  // in x
    "unlike shoulders",
    "unlike elbows",
    "unlike hands",
    "unlike hips",
    "unlike knees",
    "unlike feet",  // in y
    "left of right shoulder",
    "left of right hip",  // in x: negative where the sides are exchanged
    "narrow shoulders",
    "narrow hips",  // exp(-apart / .2)
    "most bend of knees",
    "most bend of elbows",
    "most reach of feet",  //
    "width of head",
    "width of neck",
    "width of body",
    "width of pelvis",
    "trunk",  // of the height
});

struct FacingEvidence {
  Eigen::VectorXd sided;    // kSidedInputs
  Eigen::VectorXd unsided;  // kUnsidedInputs
};

// Of the joints in the picture (Joint::image). `turned_rad`: how far the figure is turned clockwise against
// upright. Nothing where a joint of people is not there. `silhouette` must be found.
std::optional<FacingEvidence> facingEvidence(const Skeleton& skeleton, const Silhouette& silhouette,
                                             double turned_rad);

}  // namespace skel
