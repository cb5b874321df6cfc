// The figure of an opaque picture from its lines and colours.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libskel/image/image.h"
#include "libskel/silhouette/loops.h"
#include "libskel/silhouette/mask_evidence.h"
#include "libskel/silhouette/ruling.h"
#include "libskel/silhouette/steps.h"

namespace skel {

struct PageNet;

struct Segmentation {
  Plane8 foreground;              // 255 on figures, in any number of parts
  std::string reason;             // why it is empty, where it is
  std::optional<SeenPage> seen;   // of pages that are not tidy
  std::vector<RuledLine> ruling;  // of the paper, image px
  Plane8 enclosed;                // chanceOfGround(), of workingRgb() (working_colors.h); empty: nowhere
  SilhouetteSteps steps;          // only if they are to be kept
  std::vector<Loop> loops;        // the same; pixels of workingRgb()
};

// Works for drawings on paper (also photographed in uneven light), line art whose white fills open to the
// background through small gaps, and flat art on plain, graded or patterned backgrounds. A sheet that lies on
// something else is straightened first (page.h), the ruling of paper taken off (ruling.h), and a line of
// ground cut (ground.h); the mask is that of the picture all the same. Unless the picture is tidy, a net
// that knows pages (page_net.h; null: the built-in one) says which of it is the figure. Its edge is that of
// the ink, in the picture's own px (ink_edge.h).
Segmentation segment(const Image& image, const PageNet* page_net = nullptr, bool keep_steps = false);

// Segmentation::ruling alone.
std::vector<RuledLine> rulingOf(const Image& image);

}  // namespace skel
