// Lines are found as what a closing of the brightness takes away (the black top hat: F. Meyer, "Contrast
// feature extraction", 1979), areas as connected pixels of like colour.
#include "libskel/mesh/drawn_areas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "libskel/mesh/ink.h"

namespace skel {
namespace {

constexpr int kWorkSize = 200;        // long side of the small picture, px
constexpr double kLine = 0.022;       // half the width of what counts as a line, as a share of that long side
constexpr double kLeastCore = 0.5;    // of an area: the blurred edges of lines have less
constexpr double kLeastArea = 0.003;  // as a share of the figure's
constexpr double kInk = 70;           // of 255, the lightest
constexpr double kStroke = 1.5;       // half widths of a line: a narrower area is a stroke
constexpr int kLineContrast = 40;     // of 255
constexpr int kSameColor = 14;        // the most that neighbours of one area differ in any channel
constexpr int kLikeArea = 45;         // and that a px differs from its area
constexpr int kOnePaint = 24;         // areas of one colour differ by less
constexpr double kHatched = 0.4;      // share of lines from which on they are a colour
constexpr double kAlone = 0.5;        // px of areas around a thing drawn by lines, as a share of the others
constexpr double kHeadReach = 2;      // of hair, ears and cheeks, radii of the head's disc

constexpr int kNeighbours[8][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};

DrawnAreas shrunk(const Image& front, const Plane8& figure, int whole_px) {
  DrawnAreas small;
  small.shrink = std::max(1, (whole_px + kWorkSize - 1) / kWorkSize);
  small.width = (front.width + small.shrink - 1) / small.shrink;
  small.height = (front.height + small.shrink - 1) / small.shrink;
  small.color.assign(std::size_t(small.width) * small.height, Eigen::Vector3f::Zero());
  small.figure.assign(small.color.size(), 0);
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
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
    }
  return small;
}

// The greatest (`grow`) or least value within `radius` px each way, of the figure alone.
std::vector<float> extreme(const DrawnAreas& small, std::vector<float> values, int radius, bool grow) {
  const float sign = grow ? 1 : -1;
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = small.figure[i] ? sign * values[i] : std::numeric_limits<float>::lowest();
  for (const bool across : {true, false}) {
    const int length = across ? small.width : small.height, stride = across ? 1 : small.width;
    std::vector<float> result = values;
    for (int i = 0; i < int(values.size()); ++i) {
      if (!small.figure[i]) continue;
      const int at = across ? i % small.width : i / small.width;
      const int last = std::min(radius, length - 1 - at);
      for (int step = -std::min(radius, at); step <= last; ++step)
        result[i] = std::max(result[i], values[i + step * stride]);
    }
    values = std::move(result);
  }
  for (float& value : values) value *= sign;
  return values;
}

// Sums over boxes of the px that `counts` marks (F. Crow, "Summed-area tables for texture mapping", 1984).
class BoxSums {
 public:
  BoxSums(const DrawnAreas& small, const std::vector<char>& counts)
      : width_(small.width + 1), height_(small.height + 1), sums_(std::size_t(width_) * height_) {
    for (auto& sum : sums_) sum.setZero();
    for (int y = 1; y < height_; ++y)
      for (int x = 1; x < width_; ++x) {
        Eigen::Vector4d own = Eigen::Vector4d::Zero();
        const int i = small.index(x - 1, y - 1);
        if (counts[i]) own << small.color[i].cast<double>(), 1;
        at(x, y) = own + at(x - 1, y) + at(x, y - 1) - at(x - 1, y - 1);
      }
  }
  // Red, green, blue and the number of px, up to `reach` px away each way.
  Eigen::Vector4d around(int x, int y, int reach) {
    const int x0 = std::max(0, x - reach), x1 = std::min(width_ - 1, x + reach + 1);
    const int y0 = std::max(0, y - reach), y1 = std::min(height_ - 1, y + reach + 1);
    return at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0);
  }

 private:
  Eigen::Vector4d& at(int x, int y) { return sums_[std::size_t(y) * width_ + x]; }

  int width_, height_;
  std::vector<Eigen::Vector4d> sums_;
};

struct Lines {
  std::vector<char> line;   // thin dark and thin light things, with their blurred edges
  std::vector<char> hatch;  // so many of them that they are a colour
};

Lines findLines(const DrawnAreas& small, int radius, const std::vector<float>& rim,
                const std::function<bool(int, int)>& is_face, const std::function<bool(int, int)>& is_head) {
  std::vector<float> light(small.color.size(), 0);
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      if (!small.holds(x, y)) continue;
      // The middle of five: strokes of crayon are no lines.
      float five[5];
      int count = 0;
      for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        if (!small.holds(x + dx, y + dy)) continue;
        const Eigen::Vector3f& c = small.color[small.index(x + dx, y + dy)];
        five[count++] = float(inkLightness(c[0], c[1], c[2]));
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
  // The outline is no hatching.
  std::vector<char> deep = small.figure, deep_thin = thin;
  for (std::size_t i = 0; i < thin.size(); ++i)
    if (rim[i] <= 2.0f * float(radius)) deep[i] = deep_thin[i] = 0;
  BoxSums thin_sums(small, deep_thin), figure_sums(small, deep);
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      if (!small.holds(x, y)) continue;
      const int i = small.index(x, y), reach = 3 * radius;
      lines.hatch[i] =
          !is_face(x, y) && thin_sums.around(x, y, reach)[3] > kHatched * figure_sums.around(x, y, reach)[3];
      if (thin[i] && rim[i] <= float(radius)) lines.hatch[i] = 0;  // nor is its inner edge
      if (lines.hatch[i]) continue;
      lines.line[i] = thin[i];
      for (const auto& step : kNeighbours)
        if (small.holds(x + step[0], y + step[1]))
          lines.line[i] |= thin[small.index(x + step[0], y + step[1])];
    }
  return lines;
}

// Without the grain of crayon and paper, so that areas hold together, and without mixing them: the mean of
// what is like the pixel (J.-S. Lee, "Digital image smoothing and the sigma filter", 1983).
std::vector<Eigen::Vector3f> smoothed(const DrawnAreas& small, const Lines& lines, int radius) {
  std::vector<char> plain = small.figure;
  for (std::size_t i = 0; i < plain.size(); ++i) plain[i] &= !lines.line[i];
  BoxSums sums(small, plain);
  std::vector<Eigen::Vector3f> result = small.color;
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      const int i = small.index(x, y);
      if (!plain[i]) continue;
      if (lines.hatch[i]) {
        const Eigen::Vector4d sum = sums.around(x, y, 2 * radius);
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

struct Area {
  std::vector<int> px;
  int core = 0;  // px whose neighbours belong to it as well
  Eigen::Vector3f color = Eigen::Vector3f::Zero();
};

// Lines near the rim that hang together with it.
std::vector<char> outlineOf(const DrawnAreas& small) {
  std::vector<char> outline(small.figure.size(), 0);
  const auto mayBe = [&](int i) { return small.line[i] && small.rim[i] <= 2.0f * float(small.line_radius); };
  std::vector<int> open;
  for (int i = 0; i < int(outline.size()); ++i)
    if (mayBe(i) && small.rim[i] <= 1.5f) outline[i] = 1, open.push_back(i);
  for (std::size_t next = 0; next < open.size(); ++next)
    for (int k = 0; k < 4; ++k) {
      const int u = open[next] % small.width + kNeighbours[k][0];
      const int v = open[next] / small.width + kNeighbours[k][1];
      if (!small.holds(u, v)) continue;
      const int j = small.index(u, v);
      if (!outline[j] && mayBe(j)) outline[j] = 1, open.push_back(j);
    }
  return outline;
}

// `color`: smoothed.
std::vector<Area> areasOf(const DrawnAreas& small, const std::vector<Eigen::Vector3f>& color) {
  std::vector<int> area_of(small.figure.size(), -1);
  std::vector<Area> areas;
  for (int start = 0; start < int(area_of.size()); ++start) {
    if (!small.figure[start] || small.line[start] || area_of[start] >= 0) continue;
    const int id = int(areas.size());
    Area area;
    area.px.assign(1, start);
    area_of[start] = id;
    for (std::size_t next = 0; next < area.px.size(); ++next) {
      const int i = area.px[next];
      area.color += color[i];
      const Eigen::Vector3f mean = area.color / float(next + 1);
      for (int k = 0; k < 4; ++k) {
        const int u = i % small.width + kNeighbours[k][0], v = i / small.width + kNeighbours[k][1];
        if (!small.holds(u, v)) continue;
        const int j = small.index(u, v);
        if (area_of[j] >= 0 || small.line[j] || (color[i] - color[j]).cwiseAbs().maxCoeff() > kSameColor ||
            (mean - color[j]).cwiseAbs().maxCoeff() > kLikeArea)
          continue;
        area_of[j] = id;
        area.px.push_back(j);
      }
    }
    area.color /= float(area.px.size());
    areas.push_back(std::move(area));
  }
  for (int i = 0; i < int(area_of.size()); ++i) {
    if (area_of[i] < 0) continue;
    bool core = true;
    for (const auto& step : kNeighbours) {
      const int u = i % small.width + step[0], v = i / small.width + step[1];
      core &= small.holds(u, v) && area_of[small.index(u, v)] == area_of[i];
    }
    areas[area_of[i]].core += core;
  }
  return areas;
}

// The colours of all areas worth the name, the largest first, like ones as one; other px that are no lines
// wear the likest, if any is like.
void findPaints(const std::vector<Eigen::Vector3f>& color, const std::function<bool(int, int)>& is_head,
                DrawnAreas& small) {
  std::vector<Area> areas = areasOf(small, color);
  std::stable_sort(areas.begin(), areas.end(),
                   [](const Area& a, const Area& b) { return a.px.size() > b.px.size(); });
  const double figure_px = double(std::count(small.figure.begin(), small.figure.end(), 1));
  small.paint.assign(small.figure.size(), -1);
  const auto likest = [&](const Eigen::Vector3f& c, int limit) {
    int best = -1, least = limit + 1;
    for (int k = 0; k < int(small.palette.size()); ++k)
      if (const int d = int((small.palette[k] - c).cwiseAbs().maxCoeff()); d < least) least = d, best = k;
    return best;
  };
  std::vector<char> done(small.figure.size(), 0);
  for (const Area& area : areas) {
    const double size = double(area.px.size());
    // Hair may be as narrow and dark as a line.
    const auto of_head = std::count_if(area.px.begin(), area.px.end(),
                                       [&](int i) { return is_head(i % small.width, i / small.width); });
    const bool stroke = 2 * double(of_head) < size &&
                        inkLightness(area.color[0], area.color[1], area.color[2]) < kInk &&
                        2 * size < kStroke * small.line_radius * std::max(1., size - area.core);
    if (size < kLeastArea * figure_px || area.core < kLeastCore * size || stroke) continue;
    int paint = likest(area.color, kOnePaint);
    if (paint < 0) paint = int(small.palette.size()), small.palette.push_back(area.color);
    for (const int i : area.px) small.paint[i] = paint, done[i] = 1;
  }
  for (int i = 0; i < int(small.figure.size()); ++i)
    if (small.figure[i] && !done[i] && !small.line[i]) small.paint[i] = likest(color[i], kLikeArea);
  std::vector<int> hatched(small.palette.size(), 0);
  for (std::size_t i = 0; i < small.paint.size(); ++i)
    if (small.paint[i] >= 0) hatched[small.paint[i]] += small.hatch[i] ? 1 : -1;
  for (const int more : hatched) small.hatched.push_back(more > 0);
}

std::vector<char> aloneIn(const DrawnAreas& small) {
  std::vector<char> plain = small.figure, alone(small.figure.size(), 0);
  for (std::size_t i = 0; i < plain.size(); ++i) plain[i] &= small.paint[i] >= 0;
  BoxSums plain_sums(small, plain), all_sums(small, small.figure);
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      const int i = small.index(x, y), reach = 4 * small.line_radius;
      if (!small.figure[i] || small.paint[i] >= 0 || small.rim[i] > 2.0f * float(small.line_radius)) continue;
      const double plain_px = plain_sums.around(x, y, reach)[3], all_px = all_sums.around(x, y, reach)[3];
      alone[i] = plain_px < kAlone * (all_px - plain_px);
    }
  return alone;
}

}  // namespace

bool isPaper(const Eigen::Vector3f& color) {
  constexpr float kPaper = 185, kTint = 40;  // all channels are more, and differ by less
  return color.minCoeff() > kPaper && color.maxCoeff() - color.minCoeff() < kTint;
}

// Chamfer 3-4: G. Borgefors, 1986.
std::vector<float> distanceTo(const DrawnAreas& areas, const std::function<bool(int)>& is, float outside) {
  std::vector<float> distance(areas.figure.size(), outside);
  const auto at = [&](int x, int y) { return areas.holds(x, y) ? distance[areas.index(x, y)] : outside; };
  constexpr float kSide = 1, kCorner = 4.0f / 3;
  for (int y = 0; y < areas.height; ++y)
    for (int x = 0; x < areas.width; ++x)
      if (areas.holds(x, y))
        distance[areas.index(x, y)] =
            is(areas.index(x, y)) ? 0
                                  : std::min({at(x - 1, y) + kSide, at(x, y - 1) + kSide,
                                              at(x - 1, y - 1) + kCorner, at(x + 1, y - 1) + kCorner});
  for (int y = areas.height - 1; y >= 0; --y)
    for (int x = areas.width - 1; x >= 0; --x)
      if (areas.holds(x, y)) {
        float& d = distance[areas.index(x, y)];
        d = std::min({d, at(x + 1, y) + kSide, at(x, y + 1) + kSide, at(x + 1, y + 1) + kCorner,
                      at(x - 1, y + 1) + kCorner});
      }
  return distance;
}

DrawnAreas drawnAreas(const Image& front, const Plane8& figure, const std::optional<HeadDisc>& head,
                      int whole_px) {
  DrawnAreas small = shrunk(front, figure, whole_px);
  small.line_radius = std::max(1, int(std::lround(kLine * ((whole_px + small.shrink - 1) / small.shrink))));
  small.rim = distanceTo(
      small, [](int) { return false; }, 0);
  const auto fromHead = [&](int x, int y) {
    return head && head->radius > 0
               ? (Eigen::Vector2d(x, y) * small.shrink - head->center).norm() / head->radius
               : 1e9;
  };
  const auto isHead = [&](int x, int y) { return fromHead(x, y) < kHeadReach; };
  Lines lines = findLines(
      small, small.line_radius, small.rim, [&](int x, int y) { return fromHead(x, y) < 1; }, isHead);
  const std::vector<Eigen::Vector3f> color = smoothed(small, lines, small.line_radius);
  small.line = std::move(lines.line), small.hatch = std::move(lines.hatch);
  small.outline = outlineOf(small);
  findPaints(color, isHead, small);
  small.alone = aloneIn(small);
  return small;
}

}  // namespace skel
