// Which way a figure looks.
#pragma once

namespace skel {

struct Facing {
  double yaw_rad = 0;  // about the vertical: 0 to the viewer (+z), positive to the right (+x)
  double looks = 1;    // the side of the picture to which it rather looks: 1 right, -1 left
  double sure = 1;     // probability that, if it looks to a side, it is that one

  static Facing at(double yaw_rad) { return {yaw_rad, yaw_rad < 0 ? -1. : 1.}; }
};

}  // namespace skel
