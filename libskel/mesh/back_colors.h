// What the back of a drawn figure wears: its areas of colour without what is drawn on its front.
#pragma once

#include <optional>

#include "libskel/image/image.h"
#include "libskel/mesh/drawn_areas.h"

namespace skel {

// `front`: opaque, the drawing seen from the front; `figure` (of its size, not 0 on the figure) and `head` in
// its px; `part`: of its size, a Part on the figure; empty: not known. Each part that is seen from behind
// (seen_behind.h) wears the colours that lie at its rim: around head and trunk they run from one side to the
// other (ruled_back.h), on others those stay that reach the rim. Face, lines and what lies within (buttons, a
// belly, a shirt under an open jacket) go. Hatching stays as it is drawn, and so do lines that tell paper
// from paper. `whole_px`: of a piece of a figure, the long side of the whole picture that it is cut from, by
// which lines are told from areas; 0: it is the whole.
Image backColors(const Image& front, const Plane8& figure, const std::optional<HeadDisc>& head,
                 const Plane8& part = {}, int whole_px = 0);

}  // namespace skel
