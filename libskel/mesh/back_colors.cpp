// Gaps are filled along shortest ways inside the figure (E. Dijkstra, 1959).
#include "libskel/mesh/back_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <queue>
#include <vector>

#include "libskel/core/check.h"
#include "libskel/mesh/ink.h"
#include "libskel/mesh/ruled_back.h"
#include "libskel/mesh/seen_behind.h"

namespace skel {
namespace {

constexpr int kRim_px = 3;         // how near to the rim of its side a colour comes that reaches it
constexpr double kAtRim = 0.75;    // the least length of it along the rim, as a share of the root of its size
constexpr double kFromHatch = 10;  // half widths of a line: so much nearer is what is no hatching
constexpr int kAround = 12;        // px, over which light and grain are evened
constexpr float kShade = 12;       // the most that this changes a channel
constexpr int kGrain = 45;         // the most that the grain of a colour differs from it

constexpr int kEight[8][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};

class BackPainter {
 public:
  BackPainter(const Image& front, const Plane8& figure, const Plane8& part,
              const std::optional<HeadDisc>& head, int whole_px)
      : areas_(drawnAreas(front, figure, head, whole_px)) {
    Eigen::Vector2d middle(areas_.width / 2, areas_.height / 2);
    if (head) middle = (head->center / areas_.shrink).array().round();
    const UprightRows rows(areas_, middle, head ? head->up : Eigen::Vector2d(0, -1));
    seen_ = seenBehind(areas_, rows, part, head);
    paint_.assign(areas_.figure.size(), kUnpainted);
    if (head) ruleBack(areas_, seen_, rows, Side::kHead, head, paint_);
    if (part.size() != 0) ruleBack(areas_, seen_, rows, Side::kBody, head, paint_);
    keep();
    fill();
    mix();
    keepLines(head);
  }

  Image paint(const Image& front) const {
    Image back = front;
    const int shrink = areas_.shrink;
    for (int y = 0; y < back.height; ++y)
      for (int x = 0; x < back.width; ++x) {
        const int u = x / shrink, v = y / shrink;
        if (!areas_.holds(u, v)) continue;
        const std::size_t i = std::size_t(areas_.index(u, v));
        if (drawn_[i]) continue;
        std::uint8_t* p = back.pixel(x, y);
        const Eigen::Vector3f own(p[0], p[1], p[2]);
        const int at = colorAt((x + 0.5) / shrink - 0.5, (y + 0.5) / shrink - 0.5, own);
        if (at < 0) continue;
        const Eigen::Vector3f color = at == key_[i] ? local_[i] : color_[std::size_t(at)];
        // The grain of what stays stays, paper that shines through included; the edges of lines do not.
        if (same_[i] && at == key_[i] &&
            ((color - own).cwiseAbs().maxCoeff() <= kGrain || (own.sum() > color.sum() && inner_[i])))
          continue;
        for (int c = 0; c < 3; ++c) p[c] = std::uint8_t(std::lround(std::clamp(color[c], 0.0f, 255.0f)));
      }
    return back;
  }

 private:
  int paints() const { return int(areas_.palette.size()); }
  std::size_t key(Side side, int paint) const {
    return std::size_t(int(side) * (paints() + 1) + paint + (paint == kInkPaint ? paints() + 2 : 0));
  }

  // What is not ruled keeps the colours that reach its rim.
  void keep() {
    std::vector<int> size(std::size_t(kSideCount) * paints(), 0), at_rim = size;
    std::vector<int> open;
    std::vector<int>& distance = rim_;
    distance.assign(areas_.figure.size(), -1);
    for (int i = 0; i < int(distance.size()); ++i) {
      if (!areas_.figure[i]) continue;
      const int x = i % areas_.width, y = i / areas_.width;
      bool edge = areas_.outline[i];
      for (int k = 0; k < 4 && !edge; ++k)
        edge = !areas_.holds(x + kEight[k][0], y + kEight[k][1]) ||
               seen_.back[areas_.index(x + kEight[k][0], y + kEight[k][1])] != seen_.back[i];
      if (edge) distance[i] = areas_.outline[i] ? 0 : 1, open.push_back(i);
    }
    std::stable_sort(open.begin(), open.end(), [&](int a, int b) { return distance[a] < distance[b]; });
    for (std::size_t next = 0; next < open.size(); ++next) {
      const int x = open[next] % areas_.width, y = open[next] / areas_.width;
      for (int k = 0; k < 4; ++k) {
        if (!areas_.holds(x + kEight[k][0], y + kEight[k][1])) continue;
        const int j = areas_.index(x + kEight[k][0], y + kEight[k][1]);
        if (distance[j] < 0) distance[j] = distance[open[next]] + 1, open.push_back(j);
      }
    }
    const auto each = [&](auto visit) {
      for (int i = 0; i < int(paint_.size()); ++i)
        if (areas_.figure[i] && paint_[i] == kUnpainted && areas_.paint[i] >= 0 &&
            seen_.front[i] == seen_.back[i])
          visit(i, std::size_t(int(seen_.back[i]) * paints() + areas_.paint[i]));
    };
    each([&](int i, std::size_t k) { ++size[k], at_rim[k] += distance[i] <= kRim_px; });
    std::vector<char> any(kSideCount, 0);
    for (std::size_t k = 0; k < size.size(); ++k)
      any[k / std::size_t(paints())] |=
          size[k] > 0 && at_rim[k] >= kAtRim * kRim_px * std::sqrt(double(size[k]));
    each([&](int i, std::size_t k) {
      if (!any[std::size_t(seen_.back[i])] || at_rim[k] >= kAtRim * kRim_px * std::sqrt(double(size[k])))
        paint_[i] = areas_.paint[i];
    });
  }

  // From what is nearest on its side, else from anywhere.
  void fill() {
    for (const bool across : {false, true}) {
      std::vector<double> cost(paint_.size(), 1e9);
      std::vector<char> fixed(paint_.size(), 0);
      using Entry = std::pair<double, int>;
      std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
      for (int i = 0; i < int(paint_.size()); ++i)
        if (areas_.figure[i] && paint_[i] != kUnpainted && paint_[i] != kInkPaint) {
          cost[i] = areas_.hatched[paint_[i]] ? kFromHatch * areas_.line_radius : 0;
          open.emplace(cost[i], i);
          fixed[i] = 1;
        }
      while (!open.empty()) {
        const auto [reached, i] = open.top();
        open.pop();
        if (reached > cost[i]) continue;
        for (int k = 0; k < 8; ++k) {
          const int u = i % areas_.width + kEight[k][0], v = i / areas_.width + kEight[k][1];
          if (!areas_.holds(u, v)) continue;
          const int j = areas_.index(u, v);
          const double there = reached + (k < 4 ? 1 : 1.4142);
          // What is drawn by lines alone wears them.
          if (across && paint_[j] == kUnpainted && areas_.line[j]) continue;
          if (fixed[j] || there >= cost[j] || (!across && seen_.back[j] != seen_.back[i]) ||
              paint_[j] == kInkPaint)
            continue;
          cost[j] = there, paint_[j] = paint_[i];
          open.emplace(there, j);
        }
      }
    }
  }

  // The colour of each paint on each side.
  void mix() {
    const std::size_t all = std::size_t(kSideCount) * std::size_t(paints() + 1);
    color_.assign(all, Eigen::Vector3f::Zero());
    std::vector<float> count(all, 0);
    pure_.assign(paint_.size(), 0);
    std::vector<std::array<float, 3>> ink;
    for (std::size_t i = 0; i < paint_.size(); ++i) {
      if (!areas_.figure[i]) continue;
      if (areas_.line[i] && areas_.outline[i] && areas_.rim[i] > 1)
        ink.push_back({areas_.color[i][0], areas_.color[i][1], areas_.color[i][2]});
      if (areas_.paint[i] < 0 || seen_.front[i] != seen_.back[i]) continue;
      if (areas_.hatch[i] && !areas_.hatched[areas_.paint[i]]) continue;
      // Away from lines and other colours, where there is such.
      int like = 1;
      for (const auto& step : kEight) {
        const int u = int(i) % areas_.width + step[0], v = int(i) / areas_.width + step[1];
        like += areas_.holds(u, v) && areas_.paint[areas_.index(u, v)] == areas_.paint[i];
      }
      pure_[i] = like == 9;
      const std::size_t k = key(seen_.back[i], areas_.paint[i]);
      const float weight = like == 9 ? 1000 : 1;
      color_[k] += weight * areas_.color[i], count[k] += weight;
    }
    Eigen::Vector3f black(30, 30, 30);
    if (!ink.empty()) {
      const auto middle = ink.begin() + std::ptrdiff_t(ink.size() / 3);
      std::nth_element(ink.begin(), middle, ink.end(), [](const auto& a, const auto& b) {
        return inkLightness(a[0], a[1], a[2]) < inkLightness(b[0], b[1], b[2]);
      });
      black = {(*middle)[0], (*middle)[1], (*middle)[2]};
    }
    for (int s = 0; s < kSideCount; ++s) {
      for (int p = 0; p < paints(); ++p) {
        const std::size_t k = key(Side(s), p);
        color_[k] = count[k] > 0 ? Eigen::Vector3f(color_[k] / count[k]) : areas_.palette[p];
      }
      color_[key(Side(s), kInkPaint)] = black;
    }
    key_.assign(paint_.size(), -1);
    same_.assign(paint_.size(), 0);
    for (std::size_t i = 0; i < paint_.size(); ++i) {
      if (!areas_.figure[i] || paint_[i] == kUnpainted) continue;
      key_[i] = int(key(seen_.back[i], paint_[i]));
    }
    shade();
    // What hangs together with the rim.
    std::vector<int> open;
    const auto add = [&](int i) {
      if (same_[i] || key_[i] < 0 || areas_.paint[i] != paint_[i] || seen_.front[i] != seen_.back[i]) return;
      same_[i] = 1, open.push_back(i);
    };
    for (int i = 0; i < int(paint_.size()); ++i)
      if (areas_.figure[i] && rim_[i] <= kRim_px) add(i);
    for (std::size_t next = 0; next < open.size(); ++next)
      for (int k = 0; k < 4; ++k)
        if (const int u = open[next] % areas_.width + kEight[k][0],
            v = open[next] / areas_.width + kEight[k][1];
            areas_.holds(u, v))
          if (const int j = areas_.index(u, v); seen_.back[j] == seen_.back[open[next]]) add(j);
  }

  // Paper and crayon are lighter here than there.
  void shade() {
    local_.assign(paint_.size(), Eigen::Vector3f::Zero());
    struct Box {
      int x0 = 1 << 30, y0 = 1 << 30, x1 = 0, y1 = 0;
    };
    std::vector<Box> boxes(color_.size());
    for (int i = 0; i < int(key_.size()); ++i) {
      if (key_[i] < 0) continue;
      Box& box = boxes[std::size_t(key_[i])];
      const int x = i % areas_.width, y = i / areas_.width;
      box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1), std::max(box.y1, y + 1)};
    }
    std::vector<Eigen::Vector4f> sums;
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      const Box& box = boxes[k];
      if (box.x1 == 0) continue;
      const int side = int(k) / (paints() + 1), paint = int(k) % (paints() + 1);
      const int width = box.x1 - box.x0 + 1, height = box.y1 - box.y0 + 1;
      sums.assign(std::size_t(width) * height, Eigen::Vector4f::Zero());
      for (int y = 1; y < height; ++y)
        for (int x = 1; x < width; ++x) {
          Eigen::Vector4f own = Eigen::Vector4f::Zero();
          const int i = areas_.index(x - 1 + box.x0, y - 1 + box.y0);
          if (areas_.figure[i] && areas_.paint[i] == paint && int(seen_.front[i]) == side && pure_[i])
            own << areas_.color[i], 1;
          const std::size_t at = std::size_t(y) * width + x;
          sums[at] = own + sums[at - 1] + sums[at - width] - sums[at - width - 1];
        }
      for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x) {
          const int i = areas_.index(x, y);
          if (key_[i] != int(k)) continue;
          const int u0 = std::max(0, x - box.x0 - kAround),
                    u1 = std::min(width - 1, x - box.x0 + kAround + 1);
          const int v0 = std::max(0, y - box.y0 - kAround),
                    v1 = std::min(height - 1, y - box.y0 + kAround + 1);
          const Eigen::Vector4f sum = sums[std::size_t(v1) * width + u1] -
                                      sums[std::size_t(v0) * width + u1] -
                                      sums[std::size_t(v1) * width + u0] + sums[std::size_t(v0) * width + u0];
          constexpr float kWhole = 4;
          const Eigen::Vector3f near =
              (sum.head<3>() + kWhole * color_[k]) / (std::max(0.f, sum[3]) + kWhole);
          local_[i] = color_[k] + (near - color_[k]).cwiseMax(-kShade).cwiseMin(kShade);
        }
    }
  }

  void keepLines(const std::optional<HeadDisc>& head) {
    drawn_.assign(paint_.size(), 0), inner_ = same_;
    for (int i = 0; i < int(same_.size()); ++i)
      for (const auto& step : kEight) {
        const int u = i % areas_.width + step[0], v = i / areas_.width + step[1];
        inner_[i] &= areas_.holds(u, v) && same_[areas_.index(u, v)] && key_[areas_.index(u, v)] == key_[i];
      }
    const auto ofHead = [&](int x, int y) {
      return head && (Eigen::Vector2d(x, y) * areas_.shrink - head->center).norm() < head->radius;
    };
    for (int y = 0; y < areas_.height; ++y)
      for (int x = 0; x < areas_.width; ++x) {
        if (!areas_.holds(x, y)) continue;
        const std::size_t i = std::size_t(areas_.index(x, y));
        if (key_[i] < 0 || (areas_.alone[i] && seen_.back[i] != Side::kHead)) {
          drawn_[i] = 1;
          continue;
        }
        if (areas_.hatch[i] && areas_.paint[i] == paint_[i] && seen_.front[i] == seen_.back[i]) drawn_[i] = 1;
        const bool paper = isPaper(color_[std::size_t(key_[i])]);
        if (!areas_.line[i] && areas_.paint[i] >= 0) continue;
        if (areas_.outline[i]) {
          drawn_[i] |= paper && (seen_.back[i] != Side::kHead || areas_.rim[i] <= float(areas_.line_radius));
          continue;
        }
        if (paper && areas_.line[i] && !ofHead(x, y) && isBorder(x, y)) drawn_[i] = 1;
      }
  }

  // Whether two colours meet near by, on the back as in front.
  bool isBorder(int x, int y) const {
    int one = -1;
    for (int step = -areas_.line_radius; step <= areas_.line_radius; ++step)
      for (const auto& [u, v] : {std::pair{x + step, y}, {x, y + step}}) {
        if (!areas_.holds(u, v)) continue;
        const std::size_t j = std::size_t(areas_.index(u, v));
        if (!same_[j] || key_[j] == one) continue;
        if (one >= 0) return true;
        one = key_[j];
      }
    return false;
  }

  // Which colour a place of the small picture has: the one that most around it have; where front and back
  // agree, of these the one that is likest to what is drawn there.
  int colorAt(double x, double y, const Eigen::Vector3f& own) const {
    constexpr double kReach = 1.6;
    std::array<std::pair<int, double>, 16> votes;
    int found = 0;
    bool agree = true;
    for (int v = int(std::ceil(y - kReach)); v <= int(std::floor(y + kReach)); ++v)
      for (int u = int(std::ceil(x - kReach)); u <= int(std::floor(x + kReach)); ++u) {
        if (!areas_.holds(u, v)) continue;
        const std::size_t i = std::size_t(areas_.index(u, v));
        if (key_[i] < 0) continue;
        agree = agree && same_[i];
        const double near = std::max(0., 1 - ((u - x) * (u - x) + (v - y) * (v - y)) / (kReach * kReach));
        auto* vote = std::find_if(votes.begin(), votes.begin() + found,
                                  [&](const auto& w) { return w.first == key_[i]; });
        if (vote == votes.begin() + found) *vote = {key_[i], 0}, ++found;
        vote->second += near * near;
      }
    if (found == 0) return -1;
    if (agree && found > 1)
      return std::min_element(votes.begin(), votes.begin() + found,
                              [&](const auto& a, const auto& b) {
                                return (color_[std::size_t(a.first)] - own).squaredNorm() <
                                       (color_[std::size_t(b.first)] - own).squaredNorm();
                              })
          ->first;
    return std::max_element(votes.begin(), votes.begin() + found,
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
  }

  DrawnAreas areas_;
  SeenBehind seen_;
  std::vector<int> paint_;              // of each px seen from behind
  std::vector<Eigen::Vector3f> color_;  // by key()
  std::vector<Eigen::Vector3f> local_;  // of each px, what is painted with its colour around it
  std::vector<int> key_;
  std::vector<int> rim_;     // px to what is not of its side
  std::vector<char> pure_;   // in front, all around wears the same
  std::vector<char> inner_;  // all around is the same
  std::vector<char> same_;   // front and back wear the same there
  std::vector<char> drawn_;  // stays as it is drawn
};

}  // namespace

Image backColors(const Image& front, const Plane8& figure, const std::optional<HeadDisc>& head,
                 const Plane8& part, int whole_px) {
  SKEL_CHECK_EQ(figure.rows(), front.height);
  SKEL_CHECK_EQ(figure.cols(), front.width);
  if (!(figure != 0).any()) return front;
  if (whole_px == 0) whole_px = std::max(front.width, front.height);
  return BackPainter(front, figure, part, head, whole_px).paint(front);
}

}  // namespace skel
