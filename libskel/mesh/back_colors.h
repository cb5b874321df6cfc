// What the back of a drawn figure wears: its areas of colour without what is drawn on its front.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "libskel/image/image.h"

namespace skel {

// The disc of the head that faces the viewer.
struct HeadDisc {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double radius = 0;
  Eigen::Vector2d up = {0, -1};  // from chin to top, a unit vector
};

// `front`: opaque, the drawing seen from the front; `figure` (of its size, not 0 on the figure) and `head` in
// its px. Lines and areas that lie inside the figure go (buttons, a belly); areas that reach the rim stay,
// hatched ones too. What went takes the colours of what stays, nearest first: those beside it rather than
// those above (hair, a hat), and those rather than what is below. The head is painted by head_back.h. The
// drawn outline stays as it is. `whole_px`: of a piece of a figure, the long side of the whole picture that
// it is cut from, by which lines are told from areas; 0: it is the whole.
Image backColors(const Image& front, const Plane8& figure, const std::optional<HeadDisc>& head,
                 int whole_px = 0);

}  // namespace skel
