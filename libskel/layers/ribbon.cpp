#include "libskel/layers/ribbon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace skel {
namespace {

using Eigen::Vector2d;
using Row3 = Eigen::Array<float, 1, 3>;

// As shares of the length of the limb's bones.
constexpr double kWidest = 0.34;  // half of the band
constexpr double kTip = 0.28;     // beyond the last joint
constexpr double kUsual = 0.3;    // the whole band
constexpr double kNarrowest = 0.1;
// Of the path's worth, for each section.
constexpr float kInside = 0.35f;      // what a line within the band costs, of what it is worth at its edge
constexpr float kOutside = 1;         // what each pixel beyond the figure costs
constexpr float kTurn = 0.18f;        // what a step to the side costs
constexpr float kUnusual = 0.3f;      // what a band costs that is twice as wide as limbs are, or half as wide
constexpr float kLeast = 1.1f;        // what a section must be worth, or else the limb has ended
constexpr float kEnd = 1.5f;          // what a line across the end is worth
constexpr double kStrong = 0.3;       // of the range of brightness: a difference that is worth 1
constexpr double kDrawn = 0.5;        // strength of an edge that counts as drawn
constexpr int kBlur = 2;              // sections to either side
constexpr double kLineWidth = 0.018;  // of the grid's long side

// The strip along the bones.
struct Strip {
  std::vector<Vector2d> middles, normals;
  int half = 0;                      // offsets −half … half
  Eigen::ArrayXXi inside;            // sections × offsets
  Eigen::ArrayXXf edge, across_end;  // strength, 0…1: along the strip, and across it
  Eigen::ArrayXXf light;

  int sections() const { return static_cast<int>(middles.size()); }
  int offsets() const { return 2 * half + 1; }
};

void layOut(const std::vector<Vector2d>& bones, Strip& strip) {
  std::vector<Vector2d> directions;
  for (std::size_t i = 0; i + 1 < bones.size(); ++i) {
    const Vector2d along = bones[i + 1] - bones[i];
    const int steps = std::max(1, static_cast<int>(std::lround(along.norm())));
    for (int k = 0; k < steps; ++k) {
      strip.middles.push_back(bones[i] + along * (double(k) / steps));
      directions.push_back(along.normalized());
    }
  }
  // About a joint the sections turn little by little.
  const int reach = std::max(2, strip.half / 2), count = strip.sections();
  for (int s = 0; s < count; ++s) {
    Vector2d mean = Vector2d::Zero();
    for (int t = std::max(0, s - reach); t <= std::min(count - 1, s + reach); ++t) mean += directions[t];
    if (mean.norm() < 1e-6) mean = directions[s];
    mean.normalize();
    strip.normals.push_back({-mean.y(), mean.x()});
  }
}

Strip unroll(const LookGrid& look, const std::vector<Vector2d>& bones, int half) {
  Strip strip;
  strip.half = half;
  layOut(bones, strip);
  const int rows = strip.sections(), columns = strip.offsets();
  std::array<Eigen::ArrayXXf, 3> raw, smooth;
  for (auto& channel : raw) channel.setZero(rows, columns);
  strip.inside.setZero(rows, columns);
  for (int s = 0; s < rows; ++s)
    for (int o = 0; o < columns; ++o) {
      const Vector2d p = strip.middles[s] + (o - half) * strip.normals[s];
      const auto px = static_cast<int>(std::lround(p.x())), py = static_cast<int>(std::lround(p.y()));
      if (px < 0 || py < 0 || px >= look.width || py >= look.height || look.mask(py, px) == 0) continue;
      strip.inside(s, o) = 1;
      // Bilinear, of the figure's own pixels.
      const int x = static_cast<int>(std::floor(p.x())), y = static_cast<int>(std::floor(p.y()));
      Row3 sum = Row3::Zero();
      double weights = 0;
      for (int k = 0; k < 4; ++k) {
        const int u = x + k % 2, v = y + k / 2;
        if (u < 0 || v < 0 || u >= look.width || v >= look.height || look.mask(v, u) == 0) continue;
        const double weight = (1 - std::abs(p.x() - u)) * (1 - std::abs(p.y() - v));
        sum += static_cast<float>(weight) * look.colours.row(std::int64_t{v} * look.width + u);
        weights += weight;
      }
      for (int c = 0; c < 3; ++c) raw[c](s, o) = sum[c] / static_cast<float>(weights);
    }
  for (int c = 0; c < 3; ++c) {
    smooth[c].setZero(rows, columns);
    for (int s = 0; s < rows; ++s)
      for (int o = 0; o < columns; ++o) {
        float sum = 0;
        int count = 0;
        for (int t = std::max(0, s - kBlur); t <= std::min(rows - 1, s + kBlur); ++t)
          if (strip.inside(t, o)) sum += raw[c](t, o), ++count;
        if (count) smooth[c](s, o) = sum / static_cast<float>(count);
      }
  }
  strip.light = (smooth[0] + smooth[1] + smooth[2]) / 3;
  const auto strength = [&](const std::array<Eigen::ArrayXXf, 3>& from, int s, int o, int t, int q) {
    if (s < 0 || o < 0 || t >= rows || q >= columns || !strip.inside(s, o) || !strip.inside(t, q)) return 0.f;
    float most = 0;
    for (const auto& channel : from) most = std::max(most, std::abs(channel(s, o) - channel(t, q)));
    return std::min(1.f, most / static_cast<float>(kStrong * look.range));
  };
  Eigen::ArrayXXf slope = Eigen::ArrayXXf::Zero(rows, columns);
  strip.across_end.setZero(rows, columns);
  for (int s = 0; s < rows; ++s)
    for (int o = 0; o < columns; ++o) {
      slope(s, o) = strength(smooth, s, o - 1, s, o + 1);
      strip.across_end(s, o) = strength(raw, s - 1, o, s + 1, o);
    }
  // Each edge once, at its steepest.
  strip.edge.setZero(rows, columns);
  for (int s = 0; s < rows; ++s)
    for (int o = 1; o + 1 < columns; ++o)
      if (slope(s, o) >= slope(s, o - 1) && slope(s, o) > slope(s, o + 1)) strip.edge(s, o) = slope(s, o);
  return strip;
}

// The two edges of each section, as offsets; sections after the end are not in it.
struct Path {
  std::vector<int> left, right;
};

// The figure ends beyond the offset.
bool atOutline(const Strip& strip, int s, int o, int step) {
  const int next = o + step;
  return strip.inside(s, o) && (next < 0 || next >= strip.offsets() || !strip.inside(s, next));
}

// Of an edge of the band at this offset.
float worthOf(const Strip& strip, int s, int o, int step) {
  if (atOutline(strip, s, o, step)) return 1;
  float best = 0;
  for (int k = -1; k <= 1; ++k)
    if (o + k >= 0 && o + k < strip.offsets())
      best = std::max(best, (k == 0 ? 1.f : 0.8f) * strip.edge(s, o + k));
  return 0.95f * best;
}

// Straight on first.
constexpr int kTurns[9][2] = {{0, 0}, {0, -1}, {0, 1}, {-1, 0}, {1, 0}, {-1, -1}, {-1, 1}, {1, -1}, {1, 1}};

// The costs of a step to the side in either edge add up, so that the best section before this one is looked
// for in one edge after the other.
Path bestPath(const Strip& strip, double length, int first_end) {
  using Row = Eigen::ArrayXf;
  using Worth = Eigen::ArrayXXf;  // by right and left edge, with a rim of what never is
  const int rows = strip.sections(), columns = strip.offsets(), half = strip.half;
  const int narrowest = std::max(3, static_cast<int>(std::lround(kNarrowest * length)));
  Row unusual(columns + 1), widths(columns + 1);
  for (int width = 0; width <= columns; ++width) {
    widths[width] = static_cast<float>(std::max(1, width));
    unusual[width] = kUnusual * std::abs(std::log2(widths[width] / static_cast<float>(kUsual * length)));
  }
  constexpr float kNever = -1e9f;
  std::vector<Worth> worth(rows, Worth::Constant(columns + 2, columns + 2, kNever));
  Worth turned = worth.front(), before = Worth::Zero(columns + 2, columns + 2);
  float best_end = kNever;
  int end = rows - 1, end_left = half, end_right = half;
  Row inner(columns + 1), cross(columns + 1), left(columns), right(columns);
  for (int s = 0; s < rows; ++s) {
    inner[0] = cross[0] = 0;
    for (int o = 0; o < columns; ++o) {
      const float outside = strip.inside(s, o) ? 0 : kOutside;
      inner[o + 1] = inner[o] + kInside * strip.edge(s, o) + outside;
      const bool ends = strip.inside(s, o) && (s + 1 == rows || !strip.inside(s + 1, o));
      cross[o + 1] = cross[o] + (ends ? 1 : strip.across_end(s, o));
      left[o] = worthOf(strip, s, o, -1) - outside - kLeast, right[o] = worthOf(strip, s, o, 1) - outside;
    }
    if (s > 0) {
      const Worth& last = worth[s - 1];
      for (int l = 0; l < columns + 2; ++l)
        turned.col(l).segment(1, columns) =
            last.col(l)
                .segment(1, columns)
                .max(last.col(l).head(columns).max(last.col(l).tail(columns)) - kTurn);
      for (int l = 1; l <= columns; ++l)
        before.col(l) = turned.col(l).max(turned.col(l - 1).max(turned.col(l + 1)) - kTurn);
    }
    for (int l = 0; l < columns; ++l) {
      // Those that are wide enough and about the bones.
      const int r = std::max(l + narrowest - 1, half - l),
                count = std::min(columns - 1, 3 * half - l) - r + 1;
      if (count <= 0) continue;
      auto here = worth[s].col(l + 1).segment(r + 1, count);
      here = before.col(l + 1).segment(r + 1, count) + left[l] + right.segment(r, count) -
             (inner.segment(r - 1, count) - inner[l + 2]).max(0) - unusual.segment(r - l + 1, count);
      if (s < first_end) continue;
      int at = 0;
      const float ended =
          (here + kEnd * (cross.segment(r + 1, count) - cross[l]) / widths.segment(r - l + 1, count))
              .maxCoeff(&at);
      if (ended > best_end) best_end = ended, end = s, end_left = l, end_right = r + at;
    }
  }
  Path path;
  path.left.resize(end + 1), path.right.resize(end + 1);
  for (int s = end, l = end_left, r = end_right; s >= 0; --s) {
    path.left[s] = l, path.right[s] = r;
    if (s == 0) break;
    float best = kNever;
    for (const auto& [dl, dr] : kTurns) {
      const float value = worth[s - 1](path.right[s] + dr + 1, path.left[s] + dl + 1) -
                          kTurn * static_cast<float>(std::abs(dl) + std::abs(dr));
      if (value > best) best = value, l = path.left[s] + dl, r = path.right[s] + dr;
    }
  }
  return path;
}

// A dark line that bounds the limb is its own: the outer side of it, from an offset on its inner side.
int beyondLine(const Strip& strip, int s, int o, int step, int widest, double range) {
  const auto light = [&](int at) {
    return at >= 0 && at < strip.offsets() && strip.inside(s, at) ? strip.light(s, at) : -1.f;
  };
  int darkest = o;
  for (int k = 0; k <= 2; ++k)
    if (const float here = light(o + k * step); here >= 0 && here < light(darkest)) darkest = o + k * step;
  float lightest = light(darkest);
  for (int k = 1; k <= widest; ++k) lightest = std::max(lightest, light(darkest + k * step));
  const float within = std::max(light(o - 2 * step), light(o - 3 * step));
  const auto clear = static_cast<float>(0.15 * range);
  if (lightest - light(darkest) < clear || within - light(darkest) < clear) return o;
  for (int k = 1; k <= widest; ++k)
    if (2 * light(darkest + k * step) >= lightest + light(darkest)) return darkest + (k - 1) * step;
  return o;
}

std::vector<int> medians(const std::vector<int>& values, int reach) {
  std::vector<int> result, window;
  const int count = static_cast<int>(values.size());
  for (int i = 0; i < count; ++i) {
    window.assign(values.begin() + std::max(0, i - reach), values.begin() + std::min(count, i + reach + 1));
    std::nth_element(window.begin(), window.begin() + static_cast<std::ptrdiff_t>(window.size() / 2),
                     window.end());
    result.push_back(window[window.size() / 2]);
  }
  return result;
}

// Limbs end round rather than straight: where that follows what is drawn better than a cut across does,
// sections that close the band as half an ellipse are added to its end. `line`: how thick the limb's own line
// is, which it keeps there too.
void roundEnd(const Strip& strip, const Path& path, int line, std::vector<int>& left,
              std::vector<int>& right) {
  const int end = static_cast<int>(left.size()) - 1;
  const double middle = 0.5 * (path.left[end] + path.right[end]),
               half = 0.5 * (path.right[end] - path.left[end]);
  const auto strengthAt = [&](int s, double offset, bool sideways) {
    const auto o = static_cast<int>(std::lround(offset));
    if (s < 0 || s >= strip.sections() || o < 0 || o >= strip.offsets() || !strip.inside(s, o)) return 0.f;
    float most = 0;
    for (int k = -1; k <= 1; ++k) {
      if (s + k >= 0 && s + k < strip.sections()) most = std::max(most, strip.across_end(s + k, o));
      if (sideways && o + k >= 0 && o + k < strip.offsets()) most = std::max(most, strip.edge(s, o + k));
    }
    return most;
  };
  constexpr int kSamples = 9;
  const auto along = [&](double length) {
    float sum = 0;
    for (int k = 0; k < kSamples; ++k) {
      const double across = 0.9 * (2.0 * k / (kSamples - 1) - 1);
      const double ahead = length * std::sqrt(1 - across * across);
      sum += strengthAt(end + static_cast<int>(std::lround(ahead)), middle + half * across, length > 0);
    }
    return sum / kSamples;
  };
  constexpr float kClearlyBetter = 1.15f, kEnough = 0.5f;
  double best_length = 0;
  float best = kClearlyBetter * along(0);
  for (int length = 2; length <= std::lround(1.6 * half); ++length)
    if (const float strength = along(length); strength > best && strength > kEnough)
      best = strength, best_length = length;
  const double center = 0.5 * (left.back() + right.back()), wide = 0.5 * (right.back() - left.back());
  const double length = best_length + line;
  for (int k = 1; k <= length && end + k < strip.sections(); ++k) {
    const double width =
        best_length == 0 ? wide : wide * std::sqrt(1 - k * k / ((length + 1) * (length + 1)));
    left.push_back(static_cast<int>(std::lround(center - width)));
    right.push_back(static_cast<int>(std::lround(center + width)));
  }
}

}  // namespace

Ribbon findRibbon(const LookGrid& look, const std::vector<Vector2d>& bones) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < bones.size(); ++i) length += (bones[i + 1] - bones[i]).norm();
  Ribbon ribbon;
  if (length < 8) return ribbon;
  const int long_side = std::max(look.width, look.height);
  const int half = std::clamp(static_cast<int>(std::lround(kWidest * length)), 5, long_side / 8);
  std::vector<Vector2d> reaching = bones;
  const Vector2d last = bones.back() - bones[bones.size() - 2];
  if (last.norm() > 0) reaching.push_back(bones.back() + kTip * length * last.normalized());
  const Strip strip = unroll(look, reaching, half);
  const int first_end = std::clamp(static_cast<int>(0.9 * length), 1, strip.sections() - 1);
  const Path path = bestPath(strip, length, first_end);

  const int count = static_cast<int>(path.left.size());
  std::vector<int> left = path.left, right = path.right;
  const int widest = std::max(3, static_cast<int>(std::lround(kLineWidth * long_side)));
  double inside = 0;
  std::int64_t insides = 0;
  std::vector<int> lines;  // how thick, where the limb has one
  for (int s = 0; s < count; ++s) {
    if (!atOutline(strip, s, left[s], -1)) left[s] = beyondLine(strip, s, left[s], -1, widest, look.range);
    if (!atOutline(strip, s, right[s], 1)) right[s] = beyondLine(strip, s, right[s], 1, widest, look.range);
    if (left[s] < path.left[s]) lines.push_back(path.left[s] - left[s]);
    if (right[s] > path.right[s]) lines.push_back(right[s] - path.right[s]);
    for (int o = path.left[s] + 3; o <= path.right[s] - 3; ++o)
      inside += static_cast<double>(worthOf(strip, s, o, 1)), ++insides;
  }
  ribbon.inside_strength = insides ? inside / static_cast<double>(insides) : 0;
  left = medians(left, 2), right = medians(right, 2);
  roundEnd(strip, path, lines.empty() ? 0 : medians(lines, 2 * count).front(), left, right);
  std::vector<int> widths;
  int within = 0;
  const auto pointAt = [&](int s, double o) {
    return Vector2d(strip.middles[s] + (o - half) * strip.normals[s]);
  };
  for (int s = count; s < static_cast<int>(left.size()); ++s)
    ribbon.cap.push_back({pointAt(s, left[s] - 0.5), pointAt(s, right[s] + 0.5)});
  for (int s = 0; s < count; ++s) {
    Ribbon::Section section;
    const auto side = [&](int o, int step, double& strength) {
      bool outline = false;
      for (int k = 0; k <= 2; ++k) {
        const int there = o + k * step;
        outline = outline || there < 0 || there >= strip.offsets() || !strip.inside(s, there);
      }
      strength = outline ? 1 : static_cast<double>(worthOf(strip, s, o, step));
      return outline ? BandSide::kOutline : strength >= kDrawn ? BandSide::kDrawn : BandSide::kOpen;
    };
    section.left_side = side(path.left[s], -1, section.left_strength);
    section.right_side = side(path.right[s], 1, section.right_strength);
    // Nothing is left between the limb and the outline.
    constexpr double kOver = 2.5;
    section.left = pointAt(s, left[s] - (section.left_side == BandSide::kOutline ? kOver : 0.5));
    section.right = pointAt(s, right[s] + (section.right_side == BandSide::kOutline ? kOver : 0.5));
    ribbon.sections.push_back(section);
    within += path.left[s] <= half && path.right[s] >= half;
    if (s < count / 3) widths.push_back(right[s] - left[s] + 1);
  }
  ribbon.about_bones = double(within) / std::max(1, count);
  if (!widths.empty()) {
    std::nth_element(widths.begin(), widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2),
                     widths.end());
    ribbon.root_radius = 0.5 * widths[widths.size() / 2];
  }
  return ribbon;
}

}  // namespace skel
