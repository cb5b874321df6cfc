// Lines are found as what a closing of the brightness takes away (the black top hat: F. Meyer, "Contrast
// feature extraction", 1979), areas as connected pixels of like colour, and gaps are filled along shortest
// ways inside the figure (E. Dijkstra, 1959).
#include "libskel/mesh/back_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <vector>

#include "libskel/core/check.h"
#include "libskel/mesh/head_back.h"
#include "libskel/mesh/ink.h"

namespace skel {
namespace {

constexpr int kWorkSize = 200;   // long side of the small picture that decides, px
constexpr int kRim_px = 3;       // of it: how near to the outline an area comes that lies at the rim
constexpr double kAtRim = 0.75;  // the least length of it along the rim, as a share of the root of its size
constexpr double kOpen = 0.15;   // the least share of that length that is the whole figure's rim
constexpr double kGoesOn = 0.5;  // or where what lies over the piece has its colour
constexpr double kLine = 0.022;  // half the width of what counts as a line, as a share of that long side
constexpr double kLeastCore = 0.5;              // of an area: the blurred edges of lines have less
constexpr double kLeastArea = 0.003;            // as a share of the figure's
constexpr double kInk = 70;                     // of 255, the lightest
constexpr double kStroke = 1.5;                 // half widths of a line: a narrower area is a stroke
constexpr int kLineContrast = 40;               // of 255
constexpr int kSameColor = 14;                  // the most that neighbours of one area differ in any channel
constexpr int kLikeArea = 45;                   // and that a px differs from its area
constexpr float kPaper = 185, kPaperTint = 40;  // all channels of paper are more, and differ by less
constexpr double kAlone =
    0.5;  // px of areas around a thing that is drawn by lines alone, as a share of the others
constexpr double kHatched = 0.4;  // share of lines from which on they are a colour
// As shares of the head's radius.
constexpr double kHeadReach = 2;    // hair, ears and cheeks
constexpr double kBelowHead = 1.1;  // and how far down
constexpr double kMostOf = 0.5;     // of the rim of what is the head's
// What a step of the spreading colours costs, sideways 1.
constexpr double kDown = 1.5, kUp = 3;
constexpr double kBelowHair = 4;
constexpr double kFromHatch = 10;  // half widths of a line: so much nearer is what is no hatching
constexpr double kMirrored = 4;    // half widths of a line: so far stripes and hatching go on

constexpr int kNeighbours[8][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};

struct Small {
  int width = 0, height = 0, shrink = 1;
  std::vector<Eigen::Vector3f> color;
  std::vector<char> figure;
  std::vector<char> others;                   // where the figure goes on beyond the piece; empty: nowhere
  std::vector<Eigen::Vector3f> others_color;  // and what is drawn there

  int index(int x, int y) const { return y * width + x; }
  bool holds(int x, int y) const {
    return x >= 0 && y >= 0 && x < width && y < height && figure[index(x, y)];
  }
};

Small shrunk(const Image& front, const Plane8& figure, const WholeFigure* around, int whole_px) {
  Small small;
  small.shrink = std::max(1, (whole_px + kWorkSize - 1) / kWorkSize);
  small.width = (front.width + small.shrink - 1) / small.shrink;
  small.height = (front.height + small.shrink - 1) / small.shrink;
  small.color.assign(std::size_t(small.width) * small.height, Eigen::Vector3f::Zero());
  small.figure.assign(small.color.size(), 0);
  if (around) {
    small.others.assign(small.color.size(), 0);
    small.others_color.assign(small.color.size(), Eigen::Vector3f::Zero());
  }
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      if (around) {
        const std::uint8_t* p = around->at((x + 0.5) * small.shrink, (y + 0.5) * small.shrink);
        small.others[small.index(x, y)] = p != nullptr;
        if (p != nullptr) small.others_color[small.index(x, y)] << p[0], p[1], p[2];
      }
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      int inside = 0;
      for (int v = y * small.shrink; v < std::min((y + 1) * small.shrink, front.height); ++v)
        for (int u = x * small.shrink; u < std::min((x + 1) * small.shrink, front.width); ++u) {
          if (!figure(v, u)) continue;
          const std::uint8_t* p = front.pixel(u, v);
          sum += Eigen::Vector3f(p[0], p[1], p[2]), ++inside;
        }
      if (inside == 0) continue;
      small.color[small.index(x, y)] = sum / float(inside);
      small.figure[small.index(x, y)] = 1;
      if (around) small.others[small.index(x, y)] = 0;
    }
  return small;
}

// Distance to what is outside, px (chamfer 3-4: G. Borgefors, 1986); `open`: of the whole figure.
std::vector<float> distanceToRim(const Small& small, bool open = false) {
  std::vector<float> distance(small.figure.size(), 0);
  const auto at = [&](int x, int y) {
    if (small.holds(x, y)) return distance[small.index(x, y)];
    const bool goes_on =
        open &&
        small.others[small.index(std::clamp(x, 0, small.width - 1), std::clamp(y, 0, small.height - 1))];
    return goes_on ? 1e9f : 0.0f;
  };
  constexpr float kSide = 1, kCorner = 4.0f / 3;
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x)
      if (small.holds(x, y))
        distance[small.index(x, y)] = std::min({at(x - 1, y) + kSide, at(x, y - 1) + kSide,
                                                at(x - 1, y - 1) + kCorner, at(x + 1, y - 1) + kCorner});
  for (int y = small.height - 1; y >= 0; --y)
    for (int x = small.width - 1; x >= 0; --x)
      if (small.holds(x, y)) {
        float& d = distance[small.index(x, y)];
        d = std::min({d, at(x + 1, y) + kSide, at(x, y + 1) + kSide, at(x + 1, y + 1) + kCorner,
                      at(x - 1, y + 1) + kCorner});
      }
  return distance;
}

// The greatest (`grow`) or least value within `radius` px each way, of the figure alone.
std::vector<float> extreme(const Small& small, std::vector<float> values, int radius, bool grow) {
  const float sign = grow ? 1 : -1;
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = small.figure[i] ? sign * values[i] : std::numeric_limits<float>::lowest();
  const int size = int(values.size());
  std::vector<float> result = values;
  for (const bool across : {true, false}) {
    // Columns go together.
    const int line = across ? small.width : size, stride = across ? 1 : small.width;
    for (int first = 0; first < size; first += line)
      for (int shift = stride; shift <= radius * stride && shift < line; shift += stride) {
        float *near = &result[first], *far = near + shift;
        const float *from_near = &values[first], *from_far = from_near + shift;
        for (int i = 0; i < line - shift; ++i) near[i] = std::max(near[i], from_far[i]);
        for (int i = 0; i < line - shift; ++i) far[i] = std::max(far[i], from_near[i]);
      }
    for (int i = 0; i < size; ++i)
      if (!small.figure[i]) result[i] = std::numeric_limits<float>::lowest();
    values = result;
  }
  for (float& value : values) value *= sign;
  return values;
}

// Sums over boxes of what the px have (F. Crow, "Summed-area tables for texture mapping", 1984).
template <int kNumbers>
class BoxSums {
 public:
  using Sum = Eigen::Matrix<double, kNumbers, 1>;

  template <class OwnOf>
  BoxSums(const Small& small, const OwnOf& ownOf)
      : width_(small.width + 1), height_(small.height + 1), sums_(std::size_t(width_) * height_) {
    for (auto& sum : sums_) sum.setZero();
    for (int y = 1; y < height_; ++y)
      for (int x = 1; x < width_; ++x)
        at(x, y) = ownOf(small.index(x - 1, y - 1)) + at(x - 1, y) + at(x, y - 1) - at(x - 1, y - 1);
  }
  // Up to `reach` px away each way.
  Sum around(int x, int y, int reach) {
    const int x0 = std::max(0, x - reach), x1 = std::min(width_ - 1, x + reach + 1);
    const int y0 = std::max(0, y - reach), y1 = std::min(height_ - 1, y + reach + 1);
    return at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0);
  }

 private:
  Sum& at(int x, int y) { return sums_[std::size_t(y) * width_ + x]; }

  int width_, height_;
  std::vector<Sum> sums_;
};

BoxSums<1> countsOf(const Small& small, const std::vector<char>& marked) {
  return {small, [&](int i) { return BoxSums<1>::Sum(marked[i]); }};
}

struct Lines {
  std::vector<char> line;   // thin dark and thin light things, with their blurred edges
  std::vector<char> hatch;  // so many of them that they are a colour
};

// Of the connected parts of `marked` those go that do not come near the rim along it: what is drawn by many
// lines inside of the figure (a shirt between lapels, laces) is no hatching.
void dropEnclosed(const Small& small, int near_px, const std::vector<float>& rim, std::vector<char>& marked) {
  std::vector<char> seen(marked.size(), 0);
  std::vector<int> part;
  for (int start = 0; start < int(marked.size()); ++start) {
    if (!marked[start] || seen[start]) continue;
    part.assign(1, start);
    seen[start] = 1;
    int at_rim = 0;
    for (std::size_t next = 0; next < part.size(); ++next) {
      const int i = part[next];
      at_rim += rim[i] <= float(near_px);
      for (int k = 0; k < 4; ++k) {
        const int u = i % small.width + kNeighbours[k][0], v = i / small.width + kNeighbours[k][1];
        if (!small.holds(u, v)) continue;
        const int j = small.index(u, v);
        if (marked[j] && !seen[j]) seen[j] = 1, part.push_back(j);
      }
    }
    if (at_rim >= kAtRim * near_px * std::sqrt(double(part.size()))) continue;
    for (const int i : part) marked[i] = 0;
  }
}

Lines findLines(const Small& small, int radius, const std::vector<float>& rim,
                const std::vector<float>& open_rim, const std::function<bool(int, int)>& is_face,
                const std::function<bool(int, int)>& is_head) {
  std::vector<float> own_light, light(small.color.size(), 0);
  for (const Eigen::Vector3f& c : small.color) own_light.push_back(float(inkLightness(c[0], c[1], c[2])));
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      if (!small.holds(x, y)) continue;
      // The middle of five: strokes of crayon are no lines.
      float five[5];
      int count = 0;
      for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        if (small.holds(x + dx, y + dy)) five[count++] = own_light[small.index(x + dx, y + dy)];
      }
      std::nth_element(five, five + count / 2, five + count);
      light[small.index(x, y)] = five[count / 2];
    }
  const auto closed = extreme(small, extreme(small, light, radius, true), radius, false);
  const auto opened = extreme(small, extreme(small, light, radius, false), radius, true);
  // A line at the rim has what it is drawn around on one side alone.
  const int wide = (3 * radius + 1) / 2;
  const auto closed_wide = extreme(small, extreme(small, light, wide, true), wide, false);
  std::vector<char> thin(light.size(), 0);
  for (std::size_t i = 0; i < thin.size(); ++i) {
    // Not at the head, where a narrow dark rim is hair.
    const bool outer = rim[i] <= 2.0f * float(radius) && !is_head(int(i) % small.width, int(i) / small.width);
    const float closing = outer ? closed_wide[i] : closed[i];
    thin[i] =
        small.figure[i] && (closing - light[i] > kLineContrast || light[i] - opened[i] > 2 * kLineContrast);
  }
  Lines lines{std::vector<char>(thin.size(), 0), std::vector<char>(thin.size(), 0)};
  // Hatching is finer than what is drawn by lines.
  const int fine = std::max(1, 3 * radius / 4);
  const auto closed_fine = extreme(small, extreme(small, light, fine, true), fine, false);
  const auto opened_fine = extreme(small, extreme(small, light, fine, false), fine, true);
  // The outline is no hatching.
  std::vector<char> deep = small.figure, deep_thin = thin;
  for (std::size_t i = 0; i < thin.size(); ++i)
    deep_thin[i] = small.figure[i] && (closed_fine[i] - light[i] > kLineContrast ||
                                       light[i] - opened_fine[i] > 2 * kLineContrast);
  for (std::size_t i = 0; i < thin.size(); ++i)
    if (rim[i] <= 2.0f * float(radius)) deep[i] = deep_thin[i] = 0;
  BoxSums<1> thin_counts = countsOf(small, deep_thin), figure_counts = countsOf(small, deep);
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      if (!small.holds(x, y)) continue;
      const int i = small.index(x, y), reach = 3 * radius;
      lines.hatch[i] = !is_face(x, y) &&
                       thin_counts.around(x, y, reach)[0] > kHatched * figure_counts.around(x, y, reach)[0];
      if (thin[i] && rim[i] <= float(radius)) lines.hatch[i] = 0;  // nor is its inner edge
    }
  dropEnclosed(small, 2 * radius, open_rim, lines.hatch);
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      const int i = small.index(x, y);
      if (!small.holds(x, y) || lines.hatch[i]) continue;
      lines.line[i] = thin[i];
      for (const auto& step : kNeighbours)
        if (small.holds(x + step[0], y + step[1]))
          lines.line[i] |= thin[small.index(x + step[0], y + step[1])];
    }
  return lines;
}

// Without the grain of crayon and paper, so that areas hold together, and without mixing them: the mean of
// what is like the pixel (J.-S. Lee, "Digital image smoothing and the sigma filter", 1983).
std::vector<Eigen::Vector3f> smoothed(const Small& small, const Lines& lines, int radius) {
  std::vector<char> plain = small.figure;
  for (std::size_t i = 0; i < plain.size(); ++i) plain[i] &= !lines.line[i];
  // Red, green, blue and the number of px, where anything asks.
  std::optional<BoxSums<4>> sums;
  if (std::find(lines.hatch.begin(), lines.hatch.end(), 1) != lines.hatch.end())
    sums.emplace(small, [&](int i) -> Eigen::Vector4d {
      if (!plain[i]) return Eigen::Vector4d::Zero();
      return {small.color[i][0], small.color[i][1], small.color[i][2], 1};
    });
  std::vector<Eigen::Vector3f> result = small.color;
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      const int i = small.index(x, y);
      if (!plain[i]) continue;
      if (lines.hatch[i]) {
        const Eigen::Vector4d sum = sums->around(x, y, 2 * radius);
        result[i] = (sum.head<3>() / sum[3]).cast<float>();
        continue;
      }
      constexpr int kReach = 2;
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      int count = 0;
      for (int v = std::max(0, y - kReach); v <= std::min(small.height - 1, y + kReach); ++v)
        for (int u = std::max(0, x - kReach); u <= std::min(small.width - 1, x + kReach); ++u) {
          const int j = small.index(u, v);
          if (!plain[j] || (small.color[j] - small.color[i]).cwiseAbs().maxCoeff() > kLikeArea) continue;
          sum += small.color[j], ++count;
        }
      result[i] = sum / float(count);
    }
  return result;
}

class BackPainter {
 public:
  BackPainter(const Image& front, const Plane8& figure, const WholeFigure* around,
              std::optional<HeadDisc> head, int whole_px)
      : small_(shrunk(front, figure, around, whole_px)),
        head_(std::move(head)),
        line_radius_(std::max(1, int(std::lround(kLine * ((whole_px + small_.shrink - 1) / small_.shrink))))),
        rim_(distanceToRim(small_)),
        open_rim_(small_.others.empty() ? rim_ : distanceToRim(small_, true)) {
    if (head_) head_->center /= small_.shrink, head_->radius /= small_.shrink;
    lines_ = findLines(
        small_, line_radius_, rim_, open_rim_,
        [&](int x, int y) {
          return fromHead({x, y}) < 1;
        },
        [&](int x, int y) {
          return fromHead({x, y}) < kHeadReach;
        });
    color_ = smoothed(small_, lines_, line_radius_);
    findOutline();
    findAreas();
    keepAreas();
    fill();
    keepLines();
    soften();
  }

  Image paint(const Image& front, const Plane8& figure) const {
    Image back = front;
    const int shrink = small_.shrink;
    for (int i = 0; i < int(small_.figure.size()); ++i) {
      if (!small_.figure[i] || drawn_[i]) continue;
      const bool goes_on = !kept_[i] && isBesideHatching(i);
      forTexels(i, back, [&](int x, int y) {
        std::uint8_t* p = back.pixel(x, y);
        const Eigen::Vector3f own(p[0], p[1], p[2]);
        // likest() is no farther from it.
        if (kept_[i] && (filled_[i] - own).squaredNorm() <= kLikeArea * kLikeArea) return;
        if (const std::uint8_t* there = goes_on ? mirrored(i, x, y, front, figure) : nullptr) {
          std::copy_n(there, 3, p);
          return;
        }
        const Eigen::Vector3f color = kept_[i] ? likest(i % small_.width, i / small_.width, own)
                                               : filledAt((x + 0.5) / shrink - 0.5, (y + 0.5) / shrink - 0.5);
        // The grain of what stays stays; the edge of a line beside it does not.
        if (kept_[i] && ((color - own).cwiseAbs().maxCoeff() <= kLikeArea || own.sum() > color.sum())) return;
        for (int c = 0; c < 3; ++c) p[c] = std::uint8_t(std::lround(std::clamp(color[c], 0.0f, 255.0f)));
      });
    }
    return back;
  }

  // Beyond the figure go the colours next to it, so that what samples the picture there sees no drawn
  // outline.
  void goOn(const Plane8& figure, Image& picture) const {
    constexpr int kReach = 4;
    std::vector<Eigen::Vector3i> color(small_.figure.size());
    std::vector<char> steps(small_.figure.size(), 0);  // from the figure, plus 1
    std::vector<int> open;
    for (int i = 0; i < int(color.size()); ++i) {
      if (!small_.figure[i] || rim_[i] > 2) continue;
      Eigen::Vector3i sum = Eigen::Vector3i::Zero();
      int count = 0;
      forTexels(i, picture, [&](int u, int v) {
        if (figure(v, u) == 0) return;
        const std::uint8_t* p = picture.pixel(u, v);
        sum += Eigen::Vector3i(p[0], p[1], p[2]), ++count;
      });
      color[i] = sum / std::max(1, count);
      steps[i] = 1;
      open.push_back(i);
    }
    for (std::size_t next = 0; next < open.size(); ++next) {
      const int i = open[next];
      forTexels(i, picture, [&](int u, int v) {
        if (figure(v, u) != 0) return;
        for (int c = 0; c < 3; ++c) picture.pixel(u, v)[c] = std::uint8_t(color[i][c]);
      });
      if (steps[i] > kReach) continue;
      for (const auto& [dx, dy] : kNeighbours) {
        const int u = i % small_.width + dx, v = i / small_.width + dy;
        if (u < 0 || v < 0 || u >= small_.width || v >= small_.height) continue;
        const int j = small_.index(u, v);
        if (steps[j] || small_.figure[j]) continue;
        steps[j] = char(steps[i] + 1);
        color[j] = color[i];
        open.push_back(j);
      }
    }
  }

 private:
  struct Area {
    int size = 0, at_rim = 0;
    int at_open_rim = 0;  // where that is the whole figure's
    int goes_on = 0;      // or the area goes on beyond it
    int core = 0;         // px whose neighbours belong to it as well
    int at_head_rim = 0;
    Eigen::Vector3f color = Eigen::Vector3f::Zero();
  };

  // Visits the texels of `picture` that a px shows.
  template <class Visit>
  void forTexels(int i, const Image& picture, const Visit& visit) const {
    const int x = i % small_.width * small_.shrink, y = i / small_.width * small_.shrink;
    for (int v = y; v < std::min(y + small_.shrink, picture.height); ++v)
      for (int u = x; u < std::min(x + small_.shrink, picture.width); ++u) visit(u, v);
  }

  // Lines near the rim that hang together with it.
  void findOutline() {
    outline_.assign(small_.figure.size(), 0);
    const auto mayBe = [&](int i) { return lines_.line[i] && rim_[i] <= 2.0f * float(line_radius_); };
    std::vector<int> open;
    for (int i = 0; i < int(outline_.size()); ++i)
      if (mayBe(i) && rim_[i] <= 1.5f) outline_[i] = 1, open.push_back(i);
    for (std::size_t next = 0; next < open.size(); ++next)
      for (int k = 0; k < 4; ++k) {
        const int u = open[next] % small_.width + kNeighbours[k][0];
        const int v = open[next] / small_.width + kNeighbours[k][1];
        if (!small_.holds(u, v)) continue;
        const int j = small_.index(u, v);
        if (!outline_[j] && mayBe(j)) outline_[j] = 1, open.push_back(j);
      }
  }

  Eigen::Vector2d place(int i) const { return {i % small_.width, i / small_.width}; }

  // In radii of the head, 0 at its middle.
  double fromHead(const Eigen::Vector2d& p) const {
    if (!head_ || head_->radius <= 0) return 1e9;
    return (p - head_->center).norm() / head_->radius;
  }
  bool nearHead(const Eigen::Vector2d& p) const {
    return fromHead(p) < kHeadReach && (p - head_->center).dot(head_->up) > -kBelowHead * head_->radius;
  }

  void findAreas() {
    area_.assign(small_.figure.size(), -1);
    Small inside = small_;
    for (std::size_t i = 0; i < outline_.size(); ++i) inside.figure[i] &= !outline_[i];
    const std::vector<float> to_rim = distanceToRim(inside);
    std::vector<float> to_open_rim = to_rim;
    if (!small_.others.empty()) {
      for (std::size_t i = 0; i < outline_.size(); ++i)
        inside.others[i] |= outline_[i] && open_rim_[i] > 2.0f * float(line_radius_);
      to_open_rim = distanceToRim(inside, true);
    }
    std::vector<int> open;
    for (int start = 0; start < int(area_.size()); ++start) {
      if (!small_.figure[start] || lines_.line[start] || area_[start] >= 0) continue;
      const int id = int(areas_.size());
      Area area;
      open.assign(1, start);
      area_[start] = id;
      for (std::size_t next = 0; next < open.size(); ++next) {
        const int i = open[next];
        const bool at_rim = to_rim[i] <= kRim_px;
        area.at_rim += at_rim;
        area.at_open_rim += to_open_rim[i] <= kRim_px;
        area.at_head_rim += at_rim && nearHead(place(i));
        area.color += color_[i];
        const Eigen::Vector3f mean = area.color / float(next + 1);
        for (int k = 0; k < 4; ++k) {
          const int u = i % small_.width + kNeighbours[k][0], v = i / small_.width + kNeighbours[k][1];
          if (!small_.holds(u, v)) continue;
          const int j = small_.index(u, v);
          if (area_[j] >= 0 || lines_.line[j] || (color_[i] - color_[j]).cwiseAbs().maxCoeff() > kSameColor ||
              (mean - color_[j]).cwiseAbs().maxCoeff() > kLikeArea)
            continue;
          area_[j] = id;
          open.push_back(j);
        }
      }
      area.size = int(open.size());
      area.color /= float(area.size);
      areas_.push_back(area);
    }
    for (int i = 0; i < int(area_.size()) && !small_.others.empty(); ++i)
      if (area_[i] >= 0 && to_rim[i] <= kRim_px && to_open_rim[i] > kRim_px)
        areas_[area_[i]].goes_on += goesOn(i);
    core_.assign(area_.size(), 0);
    for (int i = 0; i < int(area_.size()); ++i) {
      if (area_[i] < 0) continue;
      bool core = true;
      for (const auto& step : kNeighbours) {
        const int u = i % small_.width + step[0], v = i / small_.width + step[1];
        core &= small_.holds(u, v) && area_[small_.index(u, v)] == area_[i];
      }
      areas_[area_[i]].core += core;
      core_[i] = core;
    }
  }

  // Whether its area's colour is that of what lies over the piece near by, across a line.
  bool goesOn(int i) const {
    for (const auto& [dx, dy] : kNeighbours)
      for (int step = 1; step <= 3 * line_radius_; ++step) {
        const int u = i % small_.width + step * dx, v = i / small_.width + step * dy;
        if (u < 0 || v < 0 || u >= small_.width || v >= small_.height) break;
        const int j = small_.index(u, v);
        if (small_.others[j] &&
            (small_.others_color[j] - areas_[area_[i]].color).cwiseAbs().maxCoeff() <= kLikeArea)
          return true;
      }
    return false;
  }

  // Those at the rim.
  void keepAreas() {
    kept_.assign(small_.figure.size(), 0);
    const double figure_area = double(std::count(small_.figure.begin(), small_.figure.end(), 1));
    for (const double least_open : {kOpen, 0.}) {
      bool any = false;
      for (int i = 0; i < int(kept_.size()); ++i) {
        if (area_[i] < 0) continue;
        const Area& area = areas_[area_[i]];
        kept_[i] = area.size >= kLeastArea * figure_area && area.core >= kLeastCore * area.size &&
                   area.at_rim >= kAtRim * kRim_px * std::sqrt(double(area.size)) &&
                   (area.at_open_rim >= least_open * area.at_rim ||
                    area.at_open_rim + area.goes_on >= kGoesOn * area.at_rim);
        any |= kept_[i] && !isStroke(area_[i]);
      }
      if (any) return;
    }
    if (areas_.empty()) return;
    const auto largest = std::max_element(areas_.begin(), areas_.end(), [&](const Area& a, const Area& b) {
      return std::pair(!isStroke(a), a.size) < std::pair(!isStroke(b), b.size);
    });
    for (int i = 0; i < int(kept_.size()); ++i) kept_[i] |= area_[i] == int(largest - areas_.begin());
  }

  // Hair, a hat: its rim lies about the head.
  bool isOfHead(const Area& area) const { return area.at_head_rim > kMostOf * area.at_rim; }

  // Narrow and dark like a line: it wears its own colour, but gives it to nothing around it.
  bool isStroke(const Area& area) const {
    return !isOfHead(area) && inkLightness(area.color[0], area.color[1], area.color[2]) < kInk &&
           2 * area.size < kStroke * line_radius_ * std::max(1, area.size - area.core);
  }
  bool isStroke(int area) const { return isStroke(areas_[area]); }

  // What went takes the nearest colour that stays, from the sides rather than from above, and from there
  // rather than from below. Colours come out of the areas' inside: their edges may be mixed with lines.
  void fill() {
    origin_.resize(area_.size());
    std::iota(origin_.begin(), origin_.end(), 0);
    const Eigen::Vector2d up = head_ ? head_->up : Eigen::Vector2d(0, -1);
    double costs[8];
    for (int k = 0; k < 8; ++k) {
      const Eigen::Vector2d step(kNeighbours[k][0], kNeighbours[k][1]);
      const double rise = step.dot(up);
      costs[k] = step.norm() + (rise > 0 ? (kUp - 1) * rise : -(kDown - 1) * rise);
    }
    std::vector<double> cost(kept_.size(), 1e9);
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    for (int i = 0; i < int(kept_.size()); ++i)
      if (kept_[i] && core_[i] && !isStroke(area_[i]))
        cost[i] = lines_.hatch[i] ? kFromHatch * line_radius_ : 0;
    const auto comesNowhere = [&](int i) {  // all that is beside it costs no more
      const int x = i % small_.width, y = i / small_.width;
      return std::all_of(std::begin(kNeighbours), std::end(kNeighbours), [&](const auto& step) {
        const int u = x + step[0], v = y + step[1];
        return !small_.holds(u, v) || cost[small_.index(u, v)] <= cost[i];
      });
    };
    for (int i = 0; i < int(kept_.size()); ++i)
      if (cost[i] < 1e9 && !comesNowhere(i)) open.emplace(cost[i], i);
    while (!open.empty()) {
      const auto [reached, i] = open.top();
      open.pop();
      if (reached > cost[i]) continue;
      const int x = i % small_.width, y = i / small_.width;
      for (int k = 0; k < 8; ++k) {
        const int u = x + kNeighbours[k][0], v = y + kNeighbours[k][1];
        if (!small_.holds(u, v)) continue;
        const int j = small_.index(u, v);
        if (reached + costs[k] >= cost[j]) continue;  // it costs no less
        // Hair covers the skull, not the back.
        const int area = sourceOf(i);
        const bool runs = area >= 0 && isOfHead(areas_[area]) && !nearHead(place(j));
        const double there = reached + costs[k] * (runs ? kBelowHair : 1);
        if (there >= cost[j]) continue;
        cost[j] = there;
        origin_[j] = origin_[i];
        open.emplace(cost[j], j);
      }
    }
    for (const int origin : origin_) filled_.push_back(color_[origin]);
  }

  // Hatching stays as it is drawn, and lines do where they are all there is (the limbs of a stick figure) and
  // where they tell paper from paper: around and between white parts.
  void keepLines() {
    drawn_.assign(kept_.size(), 0);
    std::vector<char> plain = small_.figure, between(kept_.size(), 0);
    for (int i = 0; i < int(plain.size()); ++i)
      plain[i] &= area_[i] >= 0 && areas_[area_[i]].core >= kLeastCore * areas_[area_[i]].size;
    BoxSums<1> plain_counts = countsOf(small_, plain), all_counts = countsOf(small_, small_.figure);
    for (int y = 0; y < small_.height; ++y)
      for (int x = 0; x < small_.width; ++x) {
        const int i = small_.index(x, y);
        if (kept_[i] && (lines_.hatch[i] || isStroke(area_[i]))) drawn_[i] = 1;
        if (!small_.figure[i] || kept_[i]) continue;
        const int reach = 4 * line_radius_;
        const double plain_px = plain_counts.around(x, y, reach)[0],
                     all_px = all_counts.around(x, y, reach)[0];
        const bool alone = rim_[i] <= 2.0f * float(line_radius_) && plain_px < kAlone * (all_px - plain_px);
        const bool tells = (lines_.line[i] || area_[i] < 0) && isPaper(filled_[i]);
        drawn_[i] = alone || (tells && outline_[i]);
        between[i] = tells && !drawn_[i] && fromHead(place(i)) > 1 && isBorder(x, y);
      }
    // What is drawn on the front alone does not come to the outline.
    std::vector<int> open;
    for (int i = 0; i < int(drawn_.size()); ++i)
      if (drawn_[i]) open.push_back(i);
    for (std::size_t next = 0; next < open.size(); ++next)
      for (const auto& step : kNeighbours) {
        const int u = open[next] % small_.width + step[0], v = open[next] / small_.width + step[1];
        if (!small_.holds(u, v)) continue;
        const int j = small_.index(u, v);
        if (between[j] && !drawn_[j]) drawn_[j] = 1, open.push_back(j);
      }
  }

  static bool isPaper(const Eigen::Vector3f& color) {
    return color.minCoeff() > kPaper && color.maxCoeff() - color.minCoeff() < kPaperTint;
  }

  // The area that a px takes its colour from; -1: none.
  int sourceOf(int i) const { return area_[origin_[i]]; }

  // Whether parts of two areas meet near by.
  bool isBorder(int x, int y) const {
    const int own = sourceOf(small_.index(x, y));
    for (int step = -line_radius_; step <= line_radius_; ++step)
      for (const auto& [u, v] : {std::pair{x + step, y}, {x, y + step}})
        if (small_.holds(u, v) && sourceOf(small_.index(u, v)) != own) return true;
    return false;
  }

  // So that colours that met have no stairs between them.
  void soften() {
    constexpr int kPasses = 2;
    for (int pass = 0; pass < kPasses; ++pass) {
      const std::vector<Eigen::Vector3f> before = filled_;
      for (int y = 0; y < small_.height; ++y)
        for (int x = 0; x < small_.width; ++x) {
          if (!small_.holds(x, y) || kept_[small_.index(x, y)]) continue;
          Eigen::Vector3f sum = before[small_.index(x, y)];
          int count = 1;
          for (const auto& step : kNeighbours)
            if (small_.holds(x + step[0], y + step[1]))
              sum += before[small_.index(x + step[0], y + step[1])], ++count;
          filled_[small_.index(x, y)] = sum / float(count);
        }
    }
  }

  // Whether the px takes its colour from hatching near by.
  bool isBesideHatching(int i) const {
    const int from = origin_[i];
    return lines_.hatch[from] && (place(i) - place(from)).norm() <= kMirrored * line_radius_;
  }

  // The texel that lies as far on the other side of where px `i` takes its colour from, if that is hatching:
  // stripes and strokes go on over what went at the rim. Nothing where there is none.
  const std::uint8_t* mirrored(int i, int x, int y, const Image& front, const Plane8& figure) const {
    const int from = origin_[i], shrink = small_.shrink;
    const int u = (2 * (from % small_.width) + 1) * shrink - 1 - x,
              v = (2 * (from / small_.width) + 1) * shrink - 1 - y;
    if (u < 0 || v < 0 || u >= front.width || v >= front.height || figure(v, u) == 0) return nullptr;
    const int there = small_.index(u / shrink, v / shrink);
    return lines_.hatch[there] && kept_[there] ? front.pixel(u, v) : nullptr;
  }

  // Of the colours around, so that edges are as sharp as they are drawn.
  Eigen::Vector3f likest(int x, int y, const Eigen::Vector3f& color) const {
    Eigen::Vector3f best = filled_[small_.index(x, y)];
    for (const auto& [dx, dy] : kNeighbours) {
      if (!small_.holds(x + dx, y + dy) || !kept_[small_.index(x + dx, y + dy)]) continue;
      const Eigen::Vector3f& other = filled_[small_.index(x + dx, y + dy)];
      if ((other - color).squaredNorm() < (best - color).squaredNorm()) best = other;
    }
    return best;
  }

  // Bilinear, over the figure's px alone.
  Eigen::Vector3f filledAt(double x, double y) const {
    const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
    const double fx = x - x0, fy = y - y0;
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    double weights = 0;
    for (int v = 0; v < 2; ++v)
      for (int u = 0; u < 2; ++u) {
        if (!small_.holds(x0 + u, y0 + v)) continue;
        const double weight = (u ? fx : 1 - fx) * (v ? fy : 1 - fy) + 1e-6;
        sum += float(weight) * filled_[small_.index(x0 + u, y0 + v)];
        weights += weight;
      }
    return sum / float(std::max(weights, 1e-6));
  }

  Small small_;
  std::optional<HeadDisc> head_;  // in px of small_
  int line_radius_;
  std::vector<float> rim_, open_rim_;  // distance to it, to the whole figure's
  Lines lines_;
  std::vector<char> outline_;
  std::vector<Eigen::Vector3f> color_, filled_;
  std::vector<int> area_;  // of each px; -1: none
  std::vector<Area> areas_;
  std::vector<char> core_;  // not at its area's edge
  std::vector<char> kept_;
  std::vector<int> origin_;  // the px that a px takes its colour from
  std::vector<char> drawn_;  // stays as it is drawn
};

}  // namespace

Image backColors(const Image& front, const Plane8& figure, const std::optional<HeadDisc>& head, int whole_px,
                 const WholeFigure* around) {
  SKEL_CHECK_EQ(figure.rows(), front.height);
  SKEL_CHECK_EQ(figure.cols(), front.width);
  if (!(figure != 0).any()) return front;
  if (whole_px == 0) whole_px = std::max(front.width, front.height);
  const BackPainter painter(front, figure, around, head, whole_px);
  Image back = painter.paint(front, figure);
  if (head) paintBackOfHead(front, figure, *head, back);
  painter.goOn(figure, back);
  return back;
}

}  // namespace skel
