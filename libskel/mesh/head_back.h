// The back of a head: hair or a hat over the skull, no face.
#pragma once

#include "libskel/image/image.h"
#include "libskel/mesh/back_colors.h"

namespace skel {

// Paints the head of `back` anew, of which `front` (both opaque and of one size) is the other side; `figure`
// is not 0 on the figure. Across the head go the colours that lie at its rim, within the drawn outline, in
// areas that have edges as those in front have: hair and hats reach around to the back, a face does not.
// Where a head has hair, it covers the skull down to the ears; what is drawn along the rim itself stays as
// `back` has it.
void paintBackOfHead(const Image& front, const Plane8& figure, const HeadDisc& head, Image& back);

}  // namespace skel
