#include "libskel/mesh/head_back.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

#include "libskel/mesh/ink.h"

namespace skel {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3f;

// Lengths are in radii of the head's disc; rows go from its top down.
constexpr int kRowsPerRadius = 32;
constexpr double kTop = 1.5, kBottom = -1.05;
constexpr double kAside = 1.45;      // sideways, to the rim
constexpr double kSkip = 0.05;       // behind the rim, where paper shines through
constexpr double kBand = 0.3;        // behind the rim, whose colour counts
constexpr double kEven = 0.25;       // rows as near as this have one colour
constexpr double kPlain = 0.25;      // least share of it that is not ink, where ink is but the outline
constexpr double kFace = 0.6;        // the disc whose commonest colour is the face's
constexpr double kNape = -0.45;      // down to where hair reaches
constexpr double kLeastHair = 0.1;   // a lower stripe is a line
constexpr double kCheek = 0.3;       // share of a row below that a cheek takes of it
constexpr double kDrawnRim = 0.2;    // behind the rim, where an outline may stay
constexpr double kHang = 0.25;       // at the middle of a row, what lies so much higher at the rim
constexpr int kMixedRows = 2;        // rows to both sides whose colours are mixed
constexpr double kLeastBand = 0.16;  // a lower one goes to its neighbour
constexpr int kSamples = 2;          // a px and direction
constexpr int kOneColor = 48;        // channels of one colour differ by less
constexpr double kMostly = 0.5;      // of the rows, of their ends above the middle

bool alike(const Vector3f& a, const Vector3f& b) { return (a - b).cwiseAbs().maxCoeff() < kOneColor; }

// Channel by channel, so that many are compared at once.
struct Colors {
  std::array<std::vector<std::uint8_t>, 3> channels;

  std::size_t size() const { return channels[0].size(); }
  Vector3f operator[](std::size_t i) const {
    return {float(channels[0][i]), float(channels[1][i]), float(channels[2][i])};
  }
  void add(const Vector3f& color) {
    for (int c = 0; c < 3; ++c) channels[std::size_t(c)].push_back(std::uint8_t(color[c]));
  }
  void add(const Colors& others) {
    for (std::size_t c = 0; c < 3; ++c)
      channels[c].insert(channels[c].end(), others.channels[c].begin(), others.channels[c].end());
  }
};

constexpr std::size_t kTogether = 16;
using Bytes = std::uint8_t __attribute__((vector_size(kTogether)));

// The middle one of each channel of the colours that most of them are like.
Vector3f commonest(Colors colors) {
  const std::size_t count = colors.size(), stride = std::max<std::size_t>(1, count / 64);
  const std::size_t padded = (count + kTogether - 1) / kTogether * kTogether;
  std::vector<std::uint8_t> real(count, 1);
  real.resize(padded, 0);
  for (auto& channel : colors.channels) channel.resize(padded);
  int most = 0;
  Vector3f best = Vector3f::Zero();
  for (std::size_t i = 0; i < count; i += stride) {
    int number = 0;
    for (std::size_t first = 0; first < count; first += kTogether) {
      Bytes like;
      std::memcpy(&like, &real[first], sizeof like);
      for (const auto& channel : colors.channels) {
        Bytes other;
        std::memcpy(&other, &channel[first], sizeof other);
        const Bytes apart = other > channel[i] ? other - channel[i] : channel[i] - other;
        like &= Bytes(apart < std::uint8_t(kOneColor));
      }
      std::array<std::uint64_t, 2> halves;
      std::memcpy(&halves, &like, sizeof like);
      number += int((halves[0] + halves[1]) * 0x0101010101010101 >> 56);  // the sum of its bytes
    }
    if (number > most) most = number, best = colors[i];
  }
  Vector3f middle;
  for (int c = 0; c < 3; ++c) {
    std::vector<float> values;
    for (std::size_t i = 0; i < count; ++i)
      if (alike(colors[i], best)) values.push_back(colors[i][c]);
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    middle[c] = values[values.size() / 2];
  }
  return middle;
}

struct Side {
  double rim = 0;  // from the axis
  Vector3f color = Vector3f::Zero();
  bool face = false;
  bool outlined = true;  // what is dark at the rim is no deeper than an outline
};

class Head {
 public:
  Head(const Image& front, const Plane8& figure, const HeadDisc& disc)
      : front_(front), figure_(figure), disc_(disc), right_(-disc.up.y(), disc.up.x()) {
    Colors inner;
    for (double t = -kFace; t <= kFace; t += 1. / kRowsPerRadius)
      for (double x = -kFace; x <= kFace; x += 1. / kRowsPerRadius)
        if (x * x + t * t < kFace * kFace && inside(x, t)) inner.add(colorAt(x, t));
    if (inner.size() == 0) return;
    const Vector3f face = commonest(inner);
    const int rows = int(std::lround((kTop - kBottom) * kRowsPerRadius)) + 1;
    rows_.resize(std::size_t(rows));
    for (const int k : {0, 1}) {
      std::vector<Band> bands;
      for (int i = 0; i < rows; ++i) bands.push_back(bandOf(height(i), k == 0 ? -1 : 1));
      constexpr int kAround = int(kEven * kRowsPerRadius);
      for (int i = 0; i < rows; ++i) {
        if (bands[std::size_t(i)].rim <= 0) continue;
        Colors plain, all;
        for (int j = std::max(0, i - kAround); j <= std::min(rows - 1, i + kAround); ++j)
          plain.add(bands[std::size_t(j)].plain), all.add(bands[std::size_t(j)].all);
        if (all.size() == 0) continue;
        Side side;
        side.rim = bands[std::size_t(i)].rim;
        side.color = commonest(double(plain.size()) > kPlain * double(all.size()) ? plain : all);
        side.face = alike(side.color, face);
        side.outlined =
            double(bands[std::size_t(i)].plain.size()) > kPlain * double(bands[std::size_t(i)].all.size());
        rows_[std::size_t(i)][std::size_t(k)] = side;
      }
    }
    const auto found =
        std::count_if(rows_.begin(), rows_.end(), [](const auto& row) { return row[0] || row[1]; });
    if (double(found) < kMostly * double(rows_.size())) {
      rows_.clear();
      return;
    }
    close();
    leaveOutFeatures();
    dress();
    divide();
  }

  bool empty() const { return rows_.empty(); }
  // Whether there may be something behind a place in the head's frame or within `margin` of it.
  static bool reaches(const Vector2d& p, double margin) {
    margin += 1. / kRowsPerRadius;
    return std::abs(p.x()) < kAside + margin && p.y() < kTop + margin && p.y() > kBottom - margin;
  }

  // Of the back at a place in the head's frame; nothing where it stays. `ink`: whether it is dark now.
  std::optional<Vector3f> colorBehind(double x, double t, bool ink) const {
    const double from_top = (kTop - t) * kRowsPerRadius + .5;
    if (from_top < 0 || from_top >= double(rows_.size())) return std::nullopt;
    const int i = int(from_top);
    const auto& [left, right] = rows_[std::size_t(i)];
    if (!left || !right || x < -left->rim || x > right->rim) return std::nullopt;
    const double width = left->rim + right->rim;
    if (width <= 0) return std::nullopt;
    const double from_left = x + left->rim, from_right = right->rim - x;
    if (ink && std::min(from_left, from_right) < kDrawnRim &&
        (from_left < from_right ? left : right)->outlined)
      return std::nullopt;
    const double share = from_left / width;
    // Hair and brims hang around a ball, lowest in the middle.
    const double row = (kTop - t - kHang * 4 * share * (1 - share)) * kRowsPerRadius;
    const auto& [a, a_is_face] = seenFrom(0, row, share);
    const auto& [b, b_is_face] = seenFrom(1, row, 1 - share);
    if (alike(a, b)) return Vector3f(a + float(share) * (b - a));
    const double seam = a_is_face == b_is_face ? .5 : a_is_face ? kCheek : 1 - kCheek;
    return share < seam ? a : b;
  }

  static bool isInk(const Vector3f& c) {
    constexpr double kInk = 80;
    return inkLightness(c[0], c[1], c[2]) < kInk;
  }

  Vector2d frame(const Vector2d& p) const {
    const Vector2d d = (p - disc_.center) / disc_.radius;
    return {d.dot(right_), d.dot(disc_.up)};
  }

 private:
  static double height(int row) { return kTop - double(row) / kRowsPerRadius; }

  bool inside(double x, double t) const {
    const Eigen::Vector2i p = pixel(x, t);
    return p.x() >= 0 && p.y() >= 0 && p.x() < front_.width && p.y() < front_.height &&
           figure_(p.y(), p.x()) != 0;
  }
  Eigen::Vector2i pixel(double x, double t) const {
    const Vector2d p = disc_.center + disc_.radius * (x * right_ + t * disc_.up);
    return {int(std::lround(p.x())), int(std::lround(p.y()))};
  }
  Vector3f colorAt(double x, double t) const {
    const Eigen::Vector2i at = pixel(x, t);
    const std::uint8_t* p = front_.pixel(at.x(), at.y());
    return {float(p[0]), float(p[1]), float(p[2])};
  }

  struct Band {
    double rim = 0;     // 0: the row leaves the head elsewhere
    Colors all, plain;  // plain: without ink
  };

  // What lies behind the rim at one end of a row, towards the middle of the head.
  Band bandOf(double t, int sign) const {
    constexpr double kStep = 1. / kRowsPerRadius;
    if (!inside(0, t)) return {};
    Band band;
    while (band.rim < kAside && inside(sign * band.rim, t)) band.rim += kStep;
    if (band.rim >= kAside) return {};
    const Vector2d rim(sign * band.rim, t), inwards = -rim.normalized();
    for (double d = kSkip; d < kBand; d += kStep)
      if (const Vector2d p = rim + d * inwards; inside(p.x(), p.y())) {
        const Vector3f color = colorAt(p.x(), p.y());
        band.all.add(color);
        if (!isInk(color)) band.plain.add(color);
      }
    return band;
  }

  // Where something stands out of the head or lies at it: the colour of the nearest row that ends at a rim.
  void close() {
    for (const std::size_t k : {0, 1}) {
      std::vector<std::optional<Side>> found;
      for (const auto& row : rows_) found.push_back(row[k]);
      for (int i = 0; i < int(rows_.size()); ++i)
        for (int d = 1; !rows_[std::size_t(i)][k] && d < int(rows_.size()); ++d)
          for (const int j : {i - d, i + d})
            if (j >= 0 && j < int(rows_.size()) && found[std::size_t(j)] && !rows_[std::size_t(i)][k]) {
              rows_[std::size_t(i)][k] = found[std::size_t(j)];
              rows_[std::size_t(i)][k]->rim = std::sqrt(std::max(0., 1 - height(i) * height(i)));
            }
    }
  }

  // A row in the colour of the nearest of some others.
  void repaint(int row, std::size_t k, const std::vector<int>& others) {
    const int nearest = *std::min_element(
        others.begin(), others.end(), [row](int a, int b) { return std::abs(a - row) < std::abs(b - row); });
    Side& side = *rows_[std::size_t(row)][k];
    const Side& other = *rows_[std::size_t(nearest)][k];
    side.color = other.color, side.face = other.face;
  }

  // What lies between rows of the face, an eye or an ear, does not reach around to the back.
  void leaveOutFeatures() {
    for (const std::size_t k : {0, 1}) {
      int above = -1;
      for (int i = 0; i < int(rows_.size()); ++i) {
        if (!rows_[std::size_t(i)][k] || !rows_[std::size_t(i)][k]->face) continue;
        for (int j = above + 1; above >= 0 && j < i; ++j)
          if (rows_[std::size_t(j)][k]) repaint(j, k, {above, i});
        above = i;
      }
    }
  }

  // Hair where there is some above, in the place of cheeks.
  void dress() {
    int upper = 0, covered = 0;
    for (std::size_t i = 0; i < rows_.size() && height(int(i)) > 0; ++i)
      for (const auto& side : rows_[i])
        if (side) ++upper, covered += !side->face;
    if (covered < kMostly * upper || upper == 0) return;
    std::optional<Vector3f> hair;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      auto& [left, right] = rows_[i];
      if (!left || !right) continue;
      const bool at_left = isHair(i, 0), at_right = isHair(i, 1);
      if (at_left || at_right)
        hair = !at_left ? right->color : !at_right ? left->color : Vector3f((left->color + right->color) / 2);
      if (!hair || height(int(i)) < kNape) continue;
      for (Side* side : {&*left, &*right})
        if (side->face) side->color = *hair, side->face = false;
    }
  }

  // No line below a hat.
  bool isHair(std::size_t row, std::size_t k) const {
    const auto same = [&](std::size_t i) {
      return rows_[i][k] && !rows_[i][k]->face && alike(rows_[i][k]->color, rows_[row][k]->color);
    };
    if (!same(row)) return false;
    std::size_t begin = row, end = row + 1;
    while (begin > 0 && same(begin - 1)) --begin;
    while (end < rows_.size() && same(end)) ++end;
    return double(end - begin) >= kLeastHair * kRowsPerRadius;
  }

  // Rows of one colour at one side.
  struct Stripe {
    int begin = 0, end = 0, color = 0;  // index of a palette
    bool matched = false;               // goes across the head
    double middle = 0;                  // the row that its beginning has come to in the middle of the head
    int rows() const { return end - begin; }
  };

  // Each side in stripes of one colour: lower ones, as lines that come to the rim, go to their neighbours.
  void even() {
    std::vector<Vector3f> palette;
    std::array<std::vector<int>, 2> color;
    for (const std::size_t k : {0, 1})
      for (const auto& row : rows_) {
        if (!row[k]) return rows_.clear();
        const auto like = std::find_if(palette.begin(), palette.end(),
                                       [&](const Vector3f& c) { return alike(c, row[k]->color); });
        color[k].push_back(int(like - palette.begin()));
        if (like == palette.end()) palette.push_back(row[k]->color);
      }
    for (const std::size_t k : {0, 1}) {
      stripes_[k] = stripesOf(color[k]);
      for (const Stripe& stripe : stripes_[k]) {
        std::vector<int> own;
        for (int i = stripe.begin; i < stripe.end; ++i)
          if (color[k][std::size_t(i)] == stripe.color) own.push_back(i);
        for (int i = stripe.begin; i < stripe.end; ++i)
          if (color[k][std::size_t(i)] != stripe.color) repaint(i, k, own);
      }
    }
  }

  // Stripes of both sides, and which of them meet: areas on the back of the head have edges as those in front
  // have.
  void divide() {
    even();
    if (rows_.empty()) return;
    match();
    meet();
    mix();
  }

  // Low ones go to the higher of their neighbours.
  static std::vector<Stripe> stripesOf(std::vector<int> color) {
    while (true) {
      std::vector<Stripe> stripes;
      for (int i = 0; i < int(color.size()); ++i) {
        if (stripes.empty() || stripes.back().color != color[std::size_t(i)])
          stripes.push_back({i, i, color[std::size_t(i)]});
        stripes.back().end = i + 1;
      }
      const auto low = std::min_element(stripes.begin(), stripes.end(),
                                        [](const Stripe& a, const Stripe& b) { return a.rows() < b.rows(); });
      if (stripes.size() == 1 || low->rows() >= kLeastBand * kRowsPerRadius) return stripes;
      const bool below =
          low == stripes.begin() || (low + 1 != stripes.end() && (low + 1)->rows() > (low - 1)->rows());
      std::fill(color.begin() + low->begin, color.begin() + low->end, (below ? low + 1 : low - 1)->color);
    }
  }

  // In order from the top, those of one colour that lie about as high, as many rows as possible.
  void match() {
    std::vector<Stripe>&left = stripes_[0], &right = stripes_[1];
    const std::size_t m = left.size(), n = right.size();
    const auto worth = [&](std::size_t i, std::size_t j) {
      if (left[i].color != right[j].color) return 0;
      constexpr double kNear = .7;
      const double apart = std::abs(left[i].begin + left[i].end - right[j].begin - right[j].end) / 2.;
      const int overlap = std::min(left[i].end, right[j].end) - std::max(left[i].begin, right[j].begin);
      return overlap > 0 || apart < kNear * kRowsPerRadius ? std::min(left[i].rows(), right[j].rows()) : 0;
    };
    std::vector<std::vector<int>> best(m + 1, std::vector<int>(n + 1, 0));
    for (std::size_t i = m; i-- > 0;)
      for (std::size_t j = n; j-- > 0;) {
        best[i][j] = std::max(best[i + 1][j], best[i][j + 1]);
        if (const int w = worth(i, j); w > 0) best[i][j] = std::max(best[i][j], w + best[i + 1][j + 1]);
      }
    for (std::size_t i = 0, j = 0; i < m && j < n;)
      if (const int w = worth(i, j); w > 0 && best[i][j] == w + best[i + 1][j + 1])
        left[i++].matched = right[j++].matched = true;
      else
        ++(best[i][j] == best[i + 1][j] ? i : j);
  }

  // Between two stripes that go across, and above the first and below the last, the edges of both sides meet
  // in one point.
  void meet() {
    std::array<std::size_t, 2> from{};
    const double rows = double(rows_.size());
    while (from[0] < stripes_[0].size() || from[1] < stripes_[1].size()) {
      std::array<std::size_t, 2> to = from;  // up to the next one that goes across, it included
      double sum = 0;
      int sides = 0;
      bool last = true;
      for (const std::size_t k : {0, 1}) {
        while (to[k] < stripes_[k].size() && !stripes_[k][to[k]].matched) ++to[k];
        last = to[k] == stripes_[k].size();
        if (!last) ++to[k];
        double begins = 0;
        int count = 0;
        for (std::size_t i = std::max<std::size_t>(from[k], 1); i < to[k]; ++i)
          begins += stripes_[k][i].begin, ++count;
        if (count > 0) sum += begins / count, ++sides;
      }
      const double middle = sides == 2 ? sum / 2 : from[0] == 0 && from[1] == 0 ? 0 : last ? rows : sum;
      for (const std::size_t k : {0, 1})
        for (std::size_t i = from[k]; i < to[k]; ++i) stripes_[k][i].middle = middle;
      from = to;
    }
  }

  struct Seen {
    Vector3f color;
    bool face = false;
  };
  // What a side has at a row, `share` of the way across.
  const Seen& seenFrom(std::size_t k, double row, double share) const {
    const double t = std::min(1., 2 * share);
    std::size_t at = 0;
    for (std::size_t i = 1; i < stripes_[k].size(); ++i)
      if (const Stripe& s = stripes_[k][i]; s.begin + t * (s.middle - s.begin) <= row) at = i;
    const Stripe& stripe = stripes_[k][at];
    return seen_[k][std::size_t(std::clamp(int(row + .5), stripe.begin, stripe.end - 1))];
  }

  // Rows mixed with those of their stripe beside them.
  void mix() {
    for (const std::size_t k : {0, 1})
      for (const Stripe& stripe : stripes_[k])
        for (int i = stripe.begin; i < stripe.end; ++i) {
          Seen seen{Vector3f::Zero(), rows_[std::size_t(i)][k]->face};
          for (int d = -kMixedRows; d <= kMixedRows; ++d)
            seen.color += rows_[std::size_t(std::clamp(i + d, stripe.begin, stripe.end - 1))][k]->color;
          seen.color /= 2 * kMixedRows + 1;
          seen_[k].push_back(seen);
        }
  }

  const Image& front_;
  const Plane8& figure_;
  const HeadDisc& disc_;
  Vector2d right_;
  std::vector<std::array<std::optional<Side>, 2>> rows_;
  std::array<std::vector<Stripe>, 2> stripes_;  // from the top, without gaps
  std::array<std::vector<Seen>, 2> seen_;       // of each row
};

}  // namespace

void paintBackOfHead(const Image& front, const Plane8& figure, const HeadDisc& disc, Image& back) {
  if (disc.radius < 2) return;
  const Head head(front, figure, disc);
  if (head.empty()) return;
  const double reach = std::hypot(kAside, kTop) * disc.radius + 1;
  const int x0 = std::max(0, int(disc.center.x() - reach)),
            x1 = std::min(front.width, int(disc.center.x() + reach) + 1),
            y0 = std::max(0, int(disc.center.y() - reach)),
            y1 = std::min(front.height, int(disc.center.y() + reach) + 1);
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      if (figure(y, x) == 0 || !Head::reaches(head.frame({x, y}), 1 / disc.radius)) continue;
      std::uint8_t* p = back.pixel(x, y);
      const Vector3f now{float(p[0]), float(p[1]), float(p[2])};
      const bool ink = Head::isInk(now);
      Vector3f sum = Vector3f::Zero();
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const Vector2d at = head.frame(
            {x + (i % kSamples + .5) / kSamples - .5, y + (double(i / kSamples) + .5) / kSamples - .5});
        sum += head.colorBehind(at.x(), at.y(), ink).value_or(now);
      }
      const Vector3f color = sum / (kSamples * kSamples);
      for (int c = 0; c < 3; ++c) p[c] = std::uint8_t(std::lround(std::clamp(color[c], 0.f, 255.f)));
    }
}

}  // namespace skel
