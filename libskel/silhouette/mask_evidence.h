// What speaks for and against a mask that was found in a picture: where the net that knows pages sees the
// figure, and where the mask says it lies.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>

#include "libskel/image/image.h"

namespace skel {

// How the page net (page_net.h) sees a picture.
struct SeenPage {
  Plane8 share;        // how probably each px is figure, of 255; the picture, made smaller
  bool sheet = false;  // a sheet that lies on something was straightened
  bool ruled = false;  // ruling was taken off
  bool soft = false;   // strokes on paper, of which the core is seen
};

inline constexpr auto kMaskInputs = std::to_array<std::string_view>(
    {"overlap", "not seen", "largest not seen", "not taken", "largest not taken", "inside", "around",
     "undecided", "area", "outline", "at the border", "sheet", "ruled", "soft"});

struct MaskEvidence {
  Eigen::VectorXd inputs;  // kMaskInputs
  // The largest piece of the mask that the net does not see as figure, as a box in px of the picture:
  // x, y, width, height; empty if there is none.
  std::optional<Eigen::Array4d> doubtful;
  std::optional<Eigen::Array4d> missing;  // the same of what the net sees as figure beside the mask
};

// `mask`: 255 on the figure, of the picture.
MaskEvidence evidenceOfMask(const Plane8& mask, const SeenPage& page);

}  // namespace skel
