// What a drawing is made of: lines, and areas of colour between them.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "libskel/image/image.h"

namespace skel {

// The disc of the head that faces the viewer.
struct HeadDisc {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double radius = 0;
  Eigen::Vector2d up = {0, -1};  // from chin to top, a unit vector
};

// A small picture of the drawing, by which it is told; all vectors row by row.
struct DrawnAreas {
  int width = 0, height = 0, shrink = 1;  // px; of the drawing's a side of each
  std::vector<char> figure;
  std::vector<Eigen::Vector3f> color;
  std::vector<float> rim;     // px to what is outside
  int line_radius = 1;        // px, half the width of what counts as a line
  std::vector<char> line;     // thin dark and thin light things, with their blurred edges
  std::vector<char> hatch;    // so many of them that they are a colour
  std::vector<char> outline;  // lines along the rim
  std::vector<char> alone;    // along the rim, where hardly anything else is: limbs drawn by lines
  std::vector<Eigen::Vector3f> palette;
  std::vector<char> hatched;  // of each colour: mostly by lines
  std::vector<int> paint;     // which colour of the palette a px wears; -1: of none, as lines

  int index(int x, int y) const { return y * width + x; }
  bool holds(int x, int y) const {
    return x >= 0 && y >= 0 && x < width && y < height && figure[std::size_t(index(x, y))];
  }
};

// White, grey or yellowish.
bool isPaper(const Eigen::Vector3f& color);

// How far each px of the figure is from the nearest that `is`, px; what is outside has the distance
// `outside`.
std::vector<float> distanceTo(const DrawnAreas& areas, const std::function<bool(int)>& is, float outside);

// `front`: opaque; `figure`: of its size, not 0 on the figure; `head`: in px of both; `whole_px`: the long
// side of the picture by which lines are told from areas.
DrawnAreas drawnAreas(const Image& front, const Plane8& figure, const std::optional<HeadDisc>& head,
                      int whole_px);

}  // namespace skel
