// Which part of a drawn figure is seen where from behind.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "libskel/mesh/drawn_areas.h"

namespace skel {

// What is painted as one: the trunk with a skirt, the head with its hair, each limb, what hangs, things.
enum class Side : signed char { kNone = -1, kBody, kHead, kLimb0, kLimb1, kLimb2, kLimb3, kHanging, kThing };
inline constexpr int kSideCount = 8;

// The figure row by row from its top down, as it stands.
class UprightRows {
 public:
  UprightRows(const DrawnAreas& areas, const Eigen::Vector2d& middle, const Eigen::Vector2d& up);
  int rows() const { return rows_; }
  int columns() const { return columns_; }
  int at(int row, int column) const { return px_[std::size_t(row) * columns_ + column]; }  // -1: no figure
  int middle_row() const { return middle_row_; }                                           // of the middle
  int middle_column() const { return middle_column_; }                                     // likewise

 private:
  int rows_ = 0, columns_ = 0, middle_row_ = 0, middle_column_ = 0;
  std::vector<int> px_;
};

struct SeenBehind {
  std::vector<Side> front, back;  // of each px of `areas`
};

// What shows on both sides of something else, in a row, lies behind it, so that it is what is seen there from
// behind: the body behind a folded arm, hair behind the neck, a cape behind the body; not wings, which
// spread. A beard is not seen. `part`: of the drawing's size, a Part on the figure; empty: not known, then
// the head is what lies around its disc, in px of the drawing.
SeenBehind seenBehind(const DrawnAreas& areas, const UprightRows& rows, const Plane8& part,
                      const std::optional<HeadDisc>& head);

}  // namespace skel
