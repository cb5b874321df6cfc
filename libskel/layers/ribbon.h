// A limb as a band along its bones.
//
// Across the bones the drawing is unrolled to a strip, a row for each step along them. The band's two edges
// are the paths through it that follow lines, edges of colour and the figure's outline best and turn little:
// dynamic programming over both at once (A. Amini, T. Weymouth, R. Jain, "Using dynamic programming for
// solving variational problems in vision", 1990).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "libskel/jointnet/figure_look.h"

namespace skel {

// The drawing at the size at which limbs are looked for.
struct LookGrid {
  int width = 0, height = 0;
  double scale = 1;                                     // grid px per image px
  Eigen::Vector2d corner_px = Eigen::Vector2d::Zero();  // as in WorkingGrid
  GridColours colours;
  Plane8 mask;
  double range = 1;  // of brightness inside the figure

  Eigen::Vector2d fromImage(const Eigen::Vector2d& p) const {
    return ((p.array() + 0.5 - corner_px.array()) * scale - 0.5).matrix();
  }
  Eigen::Vector2d toImage(const Eigen::Vector2d& p) const {
    return ((p.array() + 0.5) / scale + corner_px.array() - 0.5).matrix();
  }
};

// What lies beyond the edge of a band.
enum class BandSide : std::uint8_t {
  kOutline,  // nothing: there the figure ends
  kDrawn,    // more of the figure, behind a line or an edge of colour
  kOpen,     // more of the figure, and nothing in between
};

struct Ribbon {
  struct Section {
    Eigen::Vector2d left, right;  // grid px
    BandSide left_side, right_side;
    double left_strength, right_strength;  // of what is drawn there, 0…1
  };
  std::vector<Section> sections;                    // from the root to the tip
  std::vector<std::array<Eigen::Vector2d, 2>> cap;  // left and right of what rounds it off, grid px
  double root_radius = 0;                           // half the band's width where it begins, grid px
  double about_bones = 0;                           // share of the sections that hold the bones
  double inside_strength = 0;                       // of lines in the middle of the band, mean of 0…1
};

// `bones`: from the root to the tip, at least two points, grid px.
Ribbon findRibbon(const LookGrid& look, const std::vector<Eigen::Vector2d>& bones);

}  // namespace skel
