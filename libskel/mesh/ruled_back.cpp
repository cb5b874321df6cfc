#include "libskel/mesh/ruled_back.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace skel {
namespace {

// Lengths are px of the small picture or radii of the head's disc; all thresholds were chosen by eye on
// the backs of some ninety own drawings.
constexpr double kStout = 0.5;      // radii: what is thinner than twice that stands out of the head
constexpr int kSpeck = 3;           // px: likewise, of the body
constexpr double kAside = 1.4;      // radii from the axis: what is further is not around the head
constexpr int kBand = 4;            // px behind the rim whose colour counts
constexpr double kDeepest = 0.35;   // of a row, where they are looked for
constexpr int kMode = 3;            // px around, of which most decide
constexpr double kJoin = 0.3;       // cost of a row that is joined with two
constexpr double kSlant = 0.02;     // cost of a row's slope, a row
constexpr double kMostSlant = 0.5;  // as a share of the width
constexpr double kFace = 0.6;       // the disc whose commonest colour is the face's, radii
constexpr double kNape = 0.7;       // radii below the middle, down to where hair reaches
constexpr double kHang = 0.15;      // radii: hair and brims hang around a ball, lowest in the middle
constexpr double kMostly = 0.4;     // of the ends above the middle
constexpr double kCrown = 1.3;      // radii above the middle, up to where what covers the skull is looked for
constexpr double kCovering = 0.35;  // radii along the rim of what covers the skull
constexpr double kLeastHair = 0.2;  // radii along the rim
constexpr int kWanted = -3;         // a px that is ruled and not yet painted
constexpr int kOneColor = 48;       // channels of one colour differ by less

struct RuledRow {
  int row, first, last;                                   // columns
  std::array<int, 2> paint = {kUnpainted, kUnpainted};    // at its ends
  std::array<int, 2> instead = {kUnpainted, kUnpainted};  // of ink
  std::array<int, 2> ground = {kUnpainted, kUnpainted};   // of hatching
  std::array<int, 2> extent = {1, 1};                     // rows that go on so
};

int commonest(const std::vector<int>& count) {
  const auto most = std::max_element(count.begin(), count.end());
  return most == count.end() || *most == 0 ? kUnpainted : int(most - count.begin());
}

class Ruler {
 public:
  Ruler(const DrawnAreas& areas, const SeenBehind& seen, const UprightRows& rows, Side side,
        const std::optional<HeadDisc>& head)
      : areas_(areas), seen_(seen), rows_(rows), side_(side) {
    if (side == Side::kHead && head) radius_ = head->radius / areas.shrink;
    findCore();
    findRows();
    findOwn();
    for (const int k : {0, 1}) lookAtEnds(k);
    if (side == Side::kHead) cover();
    for (const int k : {0, 1}) settle(k);
  }

  void paint(std::vector<int>& paint) const {
    for (const RuledRow& row : ruled_)
      for (int c = row.first; c < row.last; ++c) paint[px(row.row, c)] = kWanted;
    for (const auto& [i, j] : joined()) rule(ruled_[std::size_t(i)], ruled_[std::size_t(j)], paint);
    fill(paint);
    smooth(paint);
  }

 private:
  std::size_t px(int row, int column) const { return std::size_t(rows_.at(row, column)); }
  bool behind(int row, int column) const {
    return rows_.at(row, column) >= 0 && seen_.back[px(row, column)] == side_;
  }

  bool core(int row, int column) const { return behind(row, column) && core_[px(row, column)]; }

  // Of the head what is stout: horns, bows and tails of hair are not around it (an opening: J. Serra, 1982).
  void findCore() {
    const int reach = std::max(kSpeck, int(kStout * radius_));
    const std::vector<float> inside = distanceTo(
        areas_, [&](int i) { return seen_.back[std::size_t(i)] != side_; }, 0);
    const std::vector<float> away = distanceTo(
        areas_, [&](int i) { return inside[std::size_t(i)] > float(reach); },
        std::numeric_limits<float>::max());
    core_.resize(away.size());
    for (std::size_t i = 0; i < away.size(); ++i) core_[i] = away[i] <= float(reach);
  }

  // The longest run of each row.
  void findRows() {
    for (int r = 0; r < rows_.rows(); ++r) {
      RuledRow best{r, 0, 0};
      const int reach = radius_ > 0 ? int(kAside * radius_) : rows_.columns();
      const int end = std::min(rows_.columns(), rows_.middle_column() + reach + 1);
      for (int c = std::max(0, rows_.middle_column() - reach); c < end;) {
        const int first = c;
        while (c < end && core(r, c)) ++c;
        if (c - first > best.last - best.first) best = {r, first, c};
        c = std::max(c, first + 1);
      }
      if (best.last > best.first) ruled_.push_back(best);
    }
  }

  // Colours of which two fifths lie before the head's disc or above and below it: a brim, but not a box that
  // is carried beside it.
  void findOwn() {
    own_.assign(areas_.palette.size(), 1);
    if (radius_ <= 0) return;
    std::vector<int> more(own_.size(), 0);
    for (int r = 0; r < rows_.rows(); ++r)
      for (int c = 0; c < rows_.columns(); ++c) {
        if (rows_.at(r, c) < 0) continue;
        const std::size_t i = px(r, c);
        if (areas_.paint[i] >= 0 && seen_.front[i] == side_)
          more[std::size_t(areas_.paint[i])] +=
              std::abs(c - rows_.middle_column()) <= kAside * radius_ ? 3 : -2;
      }
    for (std::size_t p = 0; p < own_.size(); ++p) own_[p] = more[p] > 0;
  }

  void lookAtEnds(int k) {
    std::vector<std::vector<int>> votes;
    std::vector<char> ink;
    for (const RuledRow& row : ruled_) {
      std::vector<int> count(areas_.palette.size(), 0);
      const int deepest = std::max(kBand + 2 * areas_.line_radius, int(kDeepest * (row.last - row.first)));
      std::vector<int> hatch = count;
      int seen = 0, lines = 0, paints = 0;
      bool outline = true;
      for (int d = 0; d < std::min(deepest, row.last - row.first) && paints < kBand; ++d) {
        const std::size_t i = px(row.row, k == 0 ? row.first + d : row.last - 1 - d);
        if (seen_.front[i] != side_) continue;
        if (outline && (areas_.outline[i] || d == 0)) continue;
        outline = false;
        if (seen < kBand) lines += areas_.line[i];
        ++seen;
        if (areas_.paint[i] < 0 || !own_[std::size_t(areas_.paint[i])]) continue;
        const std::size_t of = std::size_t(areas_.paint[i]);
        if (areas_.hatched[of])
          ++hatch[of];
        else
          ++count[of], ++paints;
      }
      ink.push_back(lines >= kBand - 1);
      // Hatching is told by itself alone.
      votes.push_back(std::move(paints > 0 ? count : hatch));
    }
    const int size = int(ruled_.size());
    for (int i = 0; i < size; ++i) {
      std::vector<int> sum = votes[std::size_t(i)];
      for (const int j : {i - 1, i + 1})
        if (j >= 0 && j < size)
          for (std::size_t p = 0; p < sum.size(); ++p) sum[p] = 2 * sum[p] + votes[std::size_t(j)][p];
      ruled_[std::size_t(i)].paint[std::size_t(k)] = commonest(sum);
    }
    // A line that crosses; others run along the rim.
    for (int i = 0; i < size;) {
      const int first = i;
      while (i < size && ink[std::size_t(i)]) ++i;
      if (i > first && i - first <= 2 * areas_.line_radius)
        for (int j = first; j < i; ++j) crossed_.push_back({j, k});
      i = std::max(i, first + 1);
    }
  }

  // Hair where there is some above, in the place of cheeks.
  void cover() {
    if (radius_ <= 0) return;
    std::vector<int> inner(areas_.palette.size(), 0);
    const int reach = int(kFace * radius_);
    for (int r = -reach; r <= reach; ++r)
      for (int c = -reach; c <= reach; ++c) {
        const int row = rows_.middle_row() + r, column = rows_.middle_column() + c;
        if (r * r + c * c > reach * reach || row < 0 || row >= rows_.rows() || column < 0 ||
            column >= rows_.columns() || rows_.at(row, column) < 0)
          continue;
        const std::size_t i = px(row, column);
        if (seen_.front[i] == side_ && areas_.paint[i] >= 0) ++inner[std::size_t(areas_.paint[i])];
      }
    const int face = commonest(inner);
    if (face == kUnpainted) return;
    const auto isFace = [&](int paint) {
      return paint >= 0 &&
             (areas_.palette[std::size_t(paint)] - areas_.palette[std::size_t(face)]).cwiseAbs().maxCoeff() <
                 kOneColor;
    };
    int upper = 0, covered = 0;
    for (const RuledRow& row : ruled_)
      if (row.row < rows_.middle_row() && row.row > rows_.middle_row() - kCrown * radius_)
        for (const int paint : row.paint) upper += paint >= 0, covered += paint >= 0 && !isFace(paint);
    if (upper == 0 || covered < kMostly * upper) return;
    // What is seen at the rim for a while.
    const int least = std::max(2, int(kLeastHair * radius_));
    std::array<int, 2> of{kUnpainted, kUnpainted}, since{0, 0};
    int hair = kUnpainted;
    // What is at the rim for less (the shade of an ear, an earring) is as what is above it.
    for (const std::size_t k : {0, 1})
      for (std::size_t i = 0; i < ruled_.size();) {
        const std::size_t first = i;
        while (i < ruled_.size() && ruled_[i].paint[k] == ruled_[first].paint[k]) ++i;
        for (std::size_t j = first; first > 0 && int(i - first) < least && j < i; ++j)
          ruled_[j].paint[k] = ruled_[first - 1].paint[k];
      }
    for (RuledRow& row : ruled_) {
      for (const std::size_t k : {0, 1}) {
        since[k] = row.paint[k] == of[k] ? since[k] + 1 : 1;
        of[k] = row.paint[k];
        if (of[k] >= 0 && !isFace(of[k]) && (since[k] >= kCovering * radius_ || hair < 0)) hair = of[k];
      }
      if (row.row > rows_.middle_row() + kNape * radius_) break;
      for (int& paint : row.paint)
        if (isFace(paint) && hair >= 0) paint = hair;
    }
  }

  void settle(int k) {
    const int size = int(ruled_.size());
    const auto at = [&](int i) -> int& { return ruled_[std::size_t(i)].paint[std::size_t(k)]; };
    // What no px told is as the nearest row.
    const auto nearest = [&](int i, bool plain) {
      for (int d = 0; d < size; ++d)
        for (const int j : {i - d, i + d})
          if (j >= 0 && j < size && at(j) >= 0 && !(plain && areas_.hatched[std::size_t(at(j))]))
            return at(j);
      return kUnpainted;
    };
    std::vector<int> told;
    for (int i = 0; i < size; ++i) {
      told.push_back(nearest(i, false));
      const int ground = nearest(i, true);
      ruled_[std::size_t(i)].ground[std::size_t(k)] = ground == kUnpainted ? told.back() : ground;
    }
    for (int i = 0; i < size; ++i) at(i) = told[std::size_t(i)];
    for (int i = 0; i < size; ++i) ruled_[std::size_t(i)].instead[std::size_t(k)] = at(i);
    for (const auto& [i, of] : crossed_)
      if (side_ == Side::kBody && of == k && at(i) >= 0 && isPaper(areas_.palette[std::size_t(at(i))]))
        at(i) = kInkPaint;
    for (int i = 0; i < size;) {
      const int first = i;
      while (i < size && at(i) == at(first)) ++i;
      for (int j = first; j < i; ++j) ruled_[std::size_t(j)].extent[std::size_t(k)] = i - first;
    }
  }

  // Rows at the left and at the right that belong together (dynamic time warping: H. Sakoe, S. Chiba, 1978).
  std::vector<std::pair<int, int>> joined() const {
    const int size = int(ruled_.size());
    std::vector<std::pair<int, int>> path;
    if (size == 0) return path;
    double width = 0;
    for (const RuledRow& row : ruled_) width += row.last - row.first;
    const int most = std::max(1, int(kMostSlant * width / size));
    const auto cell = [&](int i, int j) {
      return std::size_t(i) * (2 * most + 1) + std::size_t(j - i + most);
    };
    const auto within = [&](int i, int j) {
      return i >= 0 && j >= 0 && i < size && j < size && std::abs(i - j) <= most;
    };
    std::vector<double> cost(std::size_t(size) * (2 * most + 1), std::numeric_limits<double>::infinity());
    constexpr int kFrom[3][2] = {{1, 1}, {1, 0}, {0, 1}};
    const auto reach = [&](int i, int j, int k) {
      const int a = i - kFrom[k][0], b = j - kFrom[k][1];
      return within(a, b) ? cost[cell(a, b)] + (k > 0 ? kJoin : 0) : std::numeric_limits<double>::infinity();
    };
    for (int i = 0; i < size; ++i)
      for (int j = std::max(0, i - most); j <= std::min(size - 1, i + most); ++j) {
        const double own =
            (ruled_[std::size_t(i)].paint[0] != ruled_[std::size_t(j)].paint[1]) + kSlant * std::abs(i - j);
        const double before =
            i == 0 && j == 0 ? 0 : std::min({reach(i, j, 0), reach(i, j, 1), reach(i, j, 2)});
        cost[cell(i, j)] = own + before;
      }
    int i = size - 1, j = size - 1;
    while (true) {
      path.push_back({i, j});
      if (i == 0 && j == 0) break;
      int best = 0;
      for (const int k : {1, 2})
        if (reach(i, j, k) < reach(i, j, best)) best = k;
      i -= kFrom[best][0], j -= kFrom[best][1];
    }
    std::reverse(path.begin(), path.end());
    return path;
  }

  void rule(const RuledRow& left, const RuledRow& right, std::vector<int>& paint) const {
    int l = left.paint[0], r = right.paint[1];
    double share = 0.5;
    if (l != r) {
      if (l == kInkPaint) l = left.instead[0];
      if (r == kInkPaint) r = right.instead[1];
      share = double(left.extent[0]) / (left.extent[0] + right.extent[1]);
    }
    const int c0 = left.first, c1 = right.last - 1;
    const int steps = 2 * std::max(1, c1 - c0);
    const double hang = radius_ > 0 ? 4 * kHang * 0.5 * (c1 - c0) : 0;
    for (int k = 0; k <= steps; ++k) {
      const double s = double(k) / steps;
      const int c = int(std::lround(c0 + s * (c1 - c0)));
      const int row = int(std::lround(left.row + s * (right.row - left.row) + hang * s * (1 - s)));
      if (row >= rows_.rows() || c < 0 || c >= rows_.columns() || !behind(row, c)) continue;
      int& to = paint[px(row, c)];
      if (to == kUnpainted) continue;  // elsewhere
      int with = s < share ? l : r;
      // Hatching is not drawn on where there is none; hair often is.
      const std::size_t i = px(row, c);
      if (with >= 0 && side_ == Side::kBody && areas_.hatched[std::size_t(with)] &&
          (areas_.paint[i] != with || seen_.front[i] != side_))
        with = s < share ? left.ground[0] : right.ground[1];
      if (with != kUnpainted) to = with;
    }
  }

  // Rows that nothing was ruled on wear what is nearest.
  void fill(std::vector<int>& paint) const {
    std::vector<int> open;
    for (const RuledRow& row : ruled_)
      for (int c = row.first; c < row.last; ++c)
        if (const int i = int(px(row.row, c)); paint[std::size_t(i)] >= 0) open.push_back(i);
    for (std::size_t next = 0; next < open.size(); ++next) {
      const int x = open[next] % areas_.width, y = open[next] / areas_.width;
      for (const auto& [dx, dy] : {std::pair{0, -1}, {0, 1}, {-1, 0}, {1, 0}}) {
        if (!areas_.holds(x + dx, y + dy)) continue;
        const int j = areas_.index(x + dx, y + dy);
        if (paint[std::size_t(j)] != kWanted) continue;
        paint[std::size_t(j)] = paint[std::size_t(open[next])];
        open.push_back(j);
      }
    }
    for (int& p : paint)
      if (p == kWanted) p = kUnpainted;
  }

  // What most around it wear.
  void smooth(std::vector<int>& paint) const {
    const std::vector<int> before = paint;
    std::vector<int> count(areas_.palette.size(), 0);
    for (const RuledRow& row : ruled_)
      for (int c = row.first; c < row.last; ++c) {
        const int i = int(px(row.row, c));
        if (before[std::size_t(i)] < 0) continue;
        std::fill(count.begin(), count.end(), 0);
        const int x = i % areas_.width, y = i / areas_.width;
        for (int v = y - kMode; v <= y + kMode; ++v)
          for (int u = x - kMode; u <= x + kMode; ++u)
            if (areas_.holds(u, v))
              if (const std::size_t j = std::size_t(areas_.index(u, v));
                  seen_.back[j] == side_ && before[j] >= 0)
                ++count[std::size_t(before[j])];
        paint[std::size_t(i)] = commonest(count);
      }
  }

  const DrawnAreas& areas_;
  const SeenBehind& seen_;
  const UprightRows& rows_;
  Side side_;
  double radius_ = 0;
  std::vector<char> core_;  // of each px
  std::vector<char> own_;   // of each colour
  std::vector<RuledRow> ruled_;
  std::vector<std::pair<int, int>> crossed_;  // row and end
};

}  // namespace

void ruleBack(const DrawnAreas& areas, const SeenBehind& seen, const UprightRows& rows, Side side,
              const std::optional<HeadDisc>& head, std::vector<int>& paint) {
  Ruler(areas, seen, rows, side, head).paint(paint);
}

}  // namespace skel
