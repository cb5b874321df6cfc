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

// The drawing that a piece of the figure is cut from.
struct WholeFigure {
  const Image& image;
  const Plane8& mask;         // of its size, not 0 on the figure
  Eigen::Vector2d corner_px;  // image px of the piece's picture's top left corner
  double step = 1;            // image px a px of that

  // What is drawn at a place of the piece's picture; null: nothing of the figure.
  const std::uint8_t* at(double x, double y) const {
    const auto u = static_cast<Eigen::Index>(corner_px.x() + x * step + 0.5);
    const auto v = static_cast<Eigen::Index>(corner_px.y() + y * step + 0.5);
    if (u < 0 || v < 0 || u >= mask.cols() || v >= mask.rows() || mask(v, u) == 0) return nullptr;
    return image.pixel(static_cast<int>(u), static_cast<int>(v));
  }
};

// `front`: opaque, the drawing seen from the front; `figure` (of its size, not 0 on the figure) and `head` in
// its px. Lines and areas that lie inside the figure go (buttons, a belly); areas that reach the rim stay,
// hatched ones too. What went takes the colours of what stays, nearest first: those beside it rather than
// those above (hair, a hat), and those rather than what is below. The head is painted by head_back.h. The
// drawn outline stays as it is. `whole_px`: of a piece of a figure, the long side of the whole picture that
// it is cut from, by which lines are told from areas; 0: it is the whole. `around`, of a piece:
// where the figure goes on, the piece's rim is none of the figure's, and what lies at no other, and does not
// go on there, is worn in front. Beyond the figure the result's colours go on, whatever `front` has there.
Image backColors(const Image& front, const Plane8& figure, const std::optional<HeadDisc>& head,
                 int whole_px = 0, const WholeFigure* around = nullptr);

}  // namespace skel
