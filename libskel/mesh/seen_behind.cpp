#include "libskel/mesh/seen_behind.h"

#include <algorithm>
#include <cmath>

#include "libskel/mesh/part.h"

namespace skel {
namespace {

using Eigen::Vector2d;

// Thresholds were chosen by eye on the backs of some ninety own drawings.
constexpr double kHeadAround = 1.35, kHeadDown = 1.05;  // radii of the disc, where no part is known
constexpr double kChin = 0.8;                           // radii below its middle
// What is seen of a cape on both sides, as a share of what is before it: of wings it is more.
constexpr double kCapeWidth = 1.0;
constexpr int kLeastWide = 3, kLeastHigh = 7;  // px of the small picture: less is a speck

Side sideOf(Part part) {
  switch (part) {
    case Part::kTrunk:
    case Part::kSkirt:
      return Side::kBody;
    case Part::kHead:
    case Part::kHair:
      return Side::kHead;
    case Part::kRightArm:
      return Side::kLimb0;
    case Part::kLeftArm:
      return Side::kLimb1;
    case Part::kRightLeg:
      return Side::kLimb2;
    case Part::kLeftLeg:
      return Side::kLimb3;
    case Part::kAppendix:
      return Side::kHanging;
    case Part::kThing:
      return Side::kThing;
  }
  return Side::kBody;
}

// In each row, what lies between two places that are of one side becomes part of it.
class Closing {
 public:
  Closing(const DrawnAreas& areas, const UprightRows& rows, SeenBehind& seen)
      : areas_(areas), rows_(rows), seen_(seen) {}

  // Visits the figure's runs of px in each row.
  template <class Visit>
  void each(Visit visit) const {
    for (int r = 0; r < rows_.rows(); ++r)
      for (int c = 0; c < rows_.columns();) {
        const int first = c;
        while (c < rows_.columns() && rows_.at(r, c) >= 0) ++c;
        if (c > first) visit(r, first, c);
        c = std::max(c, first + 1);
      }
  }

  // `is`: of a px; `takes`: of a px and its row; `holds`: of a row and the columns from the first to behind
  // the last such place.
  template <class Is, class Takes, class Holds>
  void over(Side side, Is is, Takes takes, Holds holds) {
    along(
        rows_.rows(), rows_.columns(), [](int line, int k) { return std::pair(line, k); }, side, is, takes,
        holds);
  }

  // Likewise in each column.
  template <class Is, class Takes>
  void overColumns(Side side, Is is, Takes takes) {
    along(
        rows_.columns(), rows_.rows(), [](int line, int k) { return std::pair(k, line); }, side, is, takes,
        [](int, int, int) { return true; });
  }

 private:
  // `place`: row and column of a line's k-th px.
  template <class Place, class Is, class Takes, class Holds>
  void along(int lines, int length, Place place, Side side, Is is, Takes takes, Holds holds) {
    const auto at = [&](int line, int k) {
      const auto [row, column] = place(line, k);
      return rows_.at(row, column);
    };
    std::vector<char> added(std::size_t(lines) * length, 0);
    for (int line = 0; line < lines; ++line)
      for (int k = 0; k < length;) {
        const int first = k;
        while (k < length && at(line, k) >= 0) ++k;
        int a = first, b = k;
        k = std::max(k, first + 1);
        const int last = b;
        // Specks are no place.
        const auto solid = [&](int from, int step) {
          for (int n = 0; n < kLeastWide; ++n)
            if (const int p = from + n * step; p < first || p >= last || !is(at(line, p))) return false;
          return true;
        };
        while (a < b && !solid(a, 1)) ++a;
        while (b > a && !solid(b - 1, -1)) --b;
        if (b - a < 2 * kLeastWide || !holds(line, a, b)) continue;
        for (int p = a; p < b; ++p)
          if (takes(at(line, p), place(line, p).first))
            added[std::size_t(line) * length + p] = seen_.back[std::size_t(at(line, p))] == side ? 1 : 2;
      }
    for (int k = 0; k < length; ++k)
      for (int line = 0; line < lines;) {
        const int first = line;
        while (line < lines && added[std::size_t(line) * length + k]) ++line;
        for (int p = first; p < line && line - first >= kLeastHigh; ++p)
          if (added[std::size_t(p) * length + k] == 2) seen_.back[std::size_t(at(p, k))] = side;
        line = std::max(line, first + 1);
      }
  }

  const DrawnAreas& areas_;
  const UprightRows& rows_;
  SeenBehind& seen_;
};

}  // namespace

UprightRows::UprightRows(const DrawnAreas& areas, const Vector2d& middle, const Vector2d& up) {
  const Vector2d right(-up.y(), up.x());
  double left = 1e9, top = 1e9, far_right = -1e9, bottom = -1e9;
  for (int y = 0; y < areas.height; ++y)
    for (int x = 0; x < areas.width; ++x) {
      if (!areas.holds(x, y)) continue;
      const Vector2d d = Vector2d(x, y) - middle;
      left = std::min(left, d.dot(right)), far_right = std::max(far_right, d.dot(right));
      top = std::min(top, -d.dot(up)), bottom = std::max(bottom, -d.dot(up));
    }
  if (left > far_right) return;
  middle_row_ = -int(std::floor(top)), middle_column_ = -int(std::floor(left));
  rows_ = middle_row_ + int(std::ceil(bottom)) + 1, columns_ = middle_column_ + int(std::ceil(far_right)) + 1;
  px_.assign(std::size_t(rows_) * columns_, -1);
  for (int r = 0; r < rows_; ++r)
    for (int c = 0; c < columns_; ++c) {
      const Vector2d p = middle + (c - middle_column_) * right - (r - middle_row_) * up;
      const int x = int(std::lround(p.x())), y = int(std::lround(p.y()));
      if (areas.holds(x, y)) px_[std::size_t(r) * columns_ + c] = areas.index(x, y);
    }
}

SeenBehind seenBehind(const DrawnAreas& areas, const UprightRows& rows, const Plane8& part,
                      const std::optional<HeadDisc>& head) {
  SeenBehind seen;
  seen.front.assign(areas.figure.size(), Side::kNone);
  std::vector<char> hair(areas.figure.size(), 0);
  const bool known = part.size() != 0;
  for (int y = 0; y < areas.height; ++y)
    for (int x = 0; x < areas.width; ++x) {
      if (!areas.holds(x, y)) continue;
      const std::size_t i = std::size_t(areas.index(x, y));
      if (known) {
        const int s = areas.shrink;
        const auto of = Part(part(std::min<Eigen::Index>(y * s + s / 2, part.rows() - 1),
                                  std::min<Eigen::Index>(x * s + s / 2, part.cols() - 1)));
        seen.front[i] = sideOf(of);
        hair[i] = of == Part::kHair;
      } else if (head) {
        const Vector2d d = (Vector2d(x, y) * areas.shrink - head->center) / head->radius;
        const bool of_head = d.norm() < kHeadAround && d.dot(head->up) > -kHeadDown;
        seen.front[i] = of_head ? Side::kHead : Side::kBody;
      } else {
        seen.front[i] = Side::kLimb0;
      }
    }
  seen.back = seen.front;
  if (!known) return seen;
  const double radius = head ? head->radius / areas.shrink : 0;
  const int chin = rows.middle_row() + int(kChin * radius), axis = rows.middle_column();
  // What shows on both sides of something lies behind it.
  Closing close(areas, rows, seen);
  close.each([&](int r, int first, int last) {
    // A beard: hair before the axis, below the chin.
    if (!head || r <= chin || axis < first || axis >= last || !hair[std::size_t(rows.at(r, axis))]) return;
    int a = axis, b = axis;
    while (a > first && hair[std::size_t(rows.at(r, a - 1))]) --a;
    while (b + 1 < last && hair[std::size_t(rows.at(r, b + 1))]) ++b;
    for (int c = a; c <= b; ++c) seen.back[std::size_t(rows.at(r, c))] = Side::kBody;
  });
  const auto isHair = [&](int i) { return hair[std::size_t(i)] != 0; };
  const auto isHeadWithHair = [&](int i) { return seen.front[std::size_t(i)] == Side::kHead; };
  close.over(
      Side::kBody, [&](int i) { return seen.front[std::size_t(i)] == Side::kBody; },
      [&](int i, int r) { return r > chin || !isHeadWithHair(i); }, [](int, int, int) { return true; });
  close.over(
      Side::kHead, [&](int i) { return isHeadWithHair(i) && !isHair(i); },
      [&](int i, int) { return seen.back[std::size_t(i)] != Side::kBody; },
      [](int, int, int) { return true; });
  // An arm that reaches to the rim has what it lies before above and below it.
  const auto isArm = [&](int i, int) {
    return seen.front[std::size_t(i)] == Side::kLimb0 || seen.front[std::size_t(i)] == Side::kLimb1;
  };
  close.overColumns(
      Side::kBody, [&](int i) { return seen.front[std::size_t(i)] == Side::kBody; }, isArm);
  close.overColumns(Side::kHead, isHeadWithHair, isArm);
  // Hair that hangs on both sides of the neck.
  if (head)
    close.over(
        Side::kHead, isHeadWithHair, [](int, int) { return true; },
        [&](int r, int a, int b) {
          return a < axis && b > axis + 1 && isHair(rows.at(r, a)) && isHair(rows.at(r, b - 1)) &&
                 !isHeadWithHair(rows.at(r, axis));
        });
  // A cape.
  const auto isHanging = [&](int i) { return seen.front[std::size_t(i)] == Side::kHanging; };
  close.over(
      Side::kHanging, isHanging, [](int, int) { return true; },
      [&](int r, int a, int b) {
        int shown = 0;
        for (int c = a; c < b; ++c) shown += isHanging(rows.at(r, c));
        return a < axis && b > axis + 1 && shown < kCapeWidth * (b - a - shown) &&
               !isHanging(rows.at(r, axis));
      });
  return seen;
}

}  // namespace skel
