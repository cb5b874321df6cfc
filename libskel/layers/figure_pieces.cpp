// What others hide of a piece is its closing by a disc (J. Serra, "Image analysis and mathematical
// morphology", 1982) that is a little larger than they are thick, as far as they cover it: an arm before the
// chest has chest on both sides of it, one that hangs beside the body has not.
#include <algorithm>
#include <cmath>
#include <optional>

#include "libskel/candidates/candidates.h"
#include "libskel/layers/layer_map.h"
#include "libskel/mesh/outline.h"

namespace skel {
namespace {

using Eigen::Vector2d;

constexpr int kCoarse = 200;          // px, the long side of the figure when hidden parts are looked for
constexpr double kThicker = 1.3;      // than half of what hides: the disc of the closing
constexpr double kLeastLimb = 0.004;  // of the figure: less is no limb

// A map at every n-th pixel of the figure's box.
struct Coarse {
  PixelBox box;
  int step = 1, margin = 0;

  Plane8 shrink(const Plane8& plane) const {
    const int rows = (box.height() + step - 1) / step, columns = (box.width() + step - 1) / step;
    Plane8 small = Plane8::Zero(rows + 2 * margin, columns + 2 * margin);
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x)
        small(y + margin, x + margin) = plane(std::min(box.y0 + y * step + step / 2, box.y1 - 1),
                                              std::min(box.x0 + x * step + step / 2, box.x1 - 1));
    return small;
  }
  std::uint8_t at(const Plane8& small, int x, int y) const {
    return small((y - box.y0) / step + margin, (x - box.x0) / step + margin);
  }
};

Plane8 where(const Plane8& plane, int value) {
  return (plane == static_cast<std::uint8_t>(value)).cast<std::uint8_t>();
}

Plane8 closing(const Plane8& mask, double radius) {
  const Plane8 grown =
      ((mask != 0) || distanceField(where(mask, 0)) <= static_cast<float>(radius)).cast<std::uint8_t>();
  return (distanceField(grown) > static_cast<float>(radius)).cast<std::uint8_t>();
}

// All but the largest 4-connected part go; returns them.
Plane8 keepLargest(Plane8& mask) {
  const auto rows = static_cast<int>(mask.rows()), columns = static_cast<int>(mask.cols());
  Plane8 rest = mask;
  std::vector<int> largest, part;
  for (int i = 0; i < mask.size(); ++i) {
    if (rest.data()[i] == 0) continue;
    part = {i};
    rest.data()[i] = 0;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const int x = part[k] % columns, y = part[k] / columns;
      const auto see = [&](int u, int v) {
        if (u < 0 || v < 0 || u >= columns || v >= rows || rest(v, u) == 0) return;
        rest(v, u) = 0;
        part.push_back(v * columns + u);
      };
      see(x + 1, y), see(x - 1, y), see(x, y + 1), see(x, y - 1);
    }
    if (part.size() > largest.size()) largest.swap(part);
  }
  rest = mask;
  for (const int i : largest) rest.data()[i] = 0;
  mask = (rest != 0).select(Plane8::Zero(rows, columns), mask);
  return rest;
}

// What of the figure the mask encloses all round: 1 there.
Plane8 enclosed(const Plane8& mask, const Plane8& figure) {
  const auto rows = static_cast<int>(mask.rows()), columns = static_cast<int>(mask.cols());
  Plane8 inside = (figure != 0 && mask == 0).cast<std::uint8_t>();
  std::vector<int> reached;
  const auto outside = [&](int x, int y) {
    return x < 0 || y < 0 || x >= columns || y >= rows || figure(y, x) == 0;
  };
  const auto open = [&](int x, int y) {
    return outside(x + 1, y) || outside(x - 1, y) || outside(x, y + 1) || outside(x, y - 1);
  };
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      if (inside(y, x) && open(x, y)) inside(y, x) = 0, reached.push_back(y * columns + x);
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const int x = reached[k] % columns, y = reached[k] / columns;
    const auto see = [&](int u, int v) {
      if (outside(u, v) || inside(v, u) == 0) return;
      inside(v, u) = 0;
      reached.push_back(v * columns + u);
    };
    see(x + 1, y), see(x - 1, y), see(x, y + 1), see(x, y - 1);
  }
  return inside;
}

// The pixels within so many of the mask's, by steps across sides and corners in turn.
Plane8 grown(Plane8 mask, int steps) {
  if (!(mask != 0).any()) return mask;
  for (int step = 0; step < steps; ++step) {
    Plane8 wide = mask;
    const Eigen::Index rows = mask.rows(), columns = mask.cols();
    wide.rightCols(columns - 1) = wide.rightCols(columns - 1).max(mask.leftCols(columns - 1));
    wide.leftCols(columns - 1) = wide.leftCols(columns - 1).max(mask.rightCols(columns - 1));
    mask = wide;
    mask.bottomRows(rows - 1) = mask.bottomRows(rows - 1).max(wide.topRows(rows - 1));
    mask.topRows(rows - 1) = mask.topRows(rows - 1).max(wide.bottomRows(rows - 1));
  }
  return mask;
}

struct Root {
  Vector2d center;
  double radius = 0;  // px
  bool holds(int x, int y) const { return (Vector2d(x, y) - center).norm() <= radius; }
};

struct Limb {
  int layer = 0;
  double half_px = 0;  // of its width where it is widest
  Root root;
};

// Half of the limb's width below its root: the median of the largest discs about the first bone that fit in.
Root rootOf(const Plane8& limb, const Coarse& coarse, const DistanceField& inside, const Vector2d& from,
            const Vector2d& to) {
  std::vector<double> radii;
  for (double t = 0.25; t <= 0.75; t += 0.05) {
    const Vector2d p = from + t * (to - from);
    const auto x = static_cast<int>(std::lround(p.x())), y = static_cast<int>(std::lround(p.y()));
    const int reach = std::max(1, static_cast<int>(0.1 * (to - from).norm() / coarse.step));
    float widest = 0;
    const int cx = (x - coarse.box.x0) / coarse.step + coarse.margin,
              cy = (y - coarse.box.y0) / coarse.step + coarse.margin;
    for (int v = std::max(0, cy - reach); v <= std::min<int>(cy + reach, int(limb.rows()) - 1); ++v)
      for (int u = std::max(0, cx - reach); u <= std::min<int>(cx + reach, int(limb.cols()) - 1); ++u)
        widest = std::max(widest, inside(v, u));
    radii.push_back(static_cast<double>(widest) * coarse.step);
  }
  std::nth_element(radii.begin(), radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2), radii.end());
  return {from, radii[radii.size() / 2]};
}

}  // namespace

std::vector<FigurePiece> figurePieces(const LayerMap& layers, const Silhouette& silhouette,
                                      const Skeleton& skeleton, const SkeletonTemplate& body_plan) {
  if (!layers.any()) return {};
  // Of the picture, the figure's box alone.
  const PixelBox box = figureBox(silhouette.mask);
  const auto cropped = [&](const Plane8& plane) {
    return Plane8(plane.block(box.y0, box.x0, box.height(), box.width()));
  };
  const Plane8 figure = cropped(silhouette.mask);
  const int rows = box.height(), columns = box.width();
  Coarse coarse;
  coarse.box = {0, 0, columns, rows};
  const int long_side = std::max(coarse.box.width(), coarse.box.height());
  coarse.step = std::max(1, long_side / kCoarse);
  const auto figure_px = static_cast<double>((figure != 0).count());
  Plane8 labels = cropped(layers.limb);

  // A limb is one part of its pixels.
  std::vector<Limb> limbs;
  for (std::size_t k = 0; k < body_plan.limbs.size(); ++k) {
    const int layer = static_cast<int>(k) + 1;
    Plane8 limb = where(labels, layer);
    if (!limb.any()) continue;
    Plane8 rest = keepLargest(limb);
    const auto jointAt = [&](int i) -> std::optional<Vector2d> {
      const auto of_plan = static_cast<std::size_t>(body_plan.limbs[k].joints[static_cast<std::size_t>(i)]);
      const int joint = skeleton.find(body_plan.joints[of_plan].name);
      if (joint < 0) return std::nullopt;
      return skeleton.joints[static_cast<std::size_t>(joint)].image - Vector2d(box.x0, box.y0);
    };
    const bool enough =
        static_cast<double>(limb.cast<int>().sum()) >= kLeastLimb * figure_px && jointAt(0) && jointAt(1);
    if (!enough) rest = where(labels, layer);
    // What is apart belongs to what lies before it, or to the body.
    labels = (rest != 0).select(Plane8::Zero(rows, columns), labels);
    if (!enough) continue;
    const Plane8 small = coarse.shrink(limb);
    const DistanceField inside = distanceField(small);
    limbs.push_back({layer, static_cast<double>(inside.maxCoeff()) * coarse.step,
                     rootOf(small, coarse, inside, *jointAt(0), *jointAt(1))});
  }
  if (limbs.empty()) return {};

  double widest = 0;
  for (const Limb& limb : limbs) widest = std::max(widest, limb.half_px);
  coarse.margin = static_cast<int>(kThicker * widest / coarse.step) + 3;
  const Plane8 small = coarse.shrink(labels), small_figure = coarse.shrink(figure);
  const auto hiddenOf = [&](int layer) {
    double half = 0;
    for (const Limb& limb : limbs)
      if (limb.layer != layer) half = std::max(half, limb.half_px);
    const Plane8 own =
        ((small == static_cast<std::uint8_t>(layer)) && (small_figure != 0)).cast<std::uint8_t>();
    // A closing stays within the convex hull.
    const PixelBox around = figureBox(own);
    const auto near = small.block(around.y0, around.x0, around.height(), around.width());
    if (half == 0 || !(near != 0 && near != static_cast<std::uint8_t>(layer)).any())
      return Plane8(Plane8::Zero(own.rows(), own.cols()));
    const Plane8 closed = closing(own, kThicker * half / coarse.step + 1);
    return Plane8(
        (closed != 0 && small != static_cast<std::uint8_t>(layer) && small != 0).cast<std::uint8_t>());
  };

  struct Draft {
    FigurePiece piece;
    std::vector<std::int64_t> under;  // of each draft: how many pixels of it hide this one
  };
  std::vector<Draft> drafts(limbs.size() + 1);
  const int soft = std::max(2, static_cast<int>(std::lround(0.006 * long_side)));
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    FigurePiece& piece = drafts[i].piece;
    piece.layer = i == 0 ? 0 : limbs[i - 1].layer;
    const Plane8 hidden = hiddenOf(piece.layer);
    piece.mask = piece.hidden = piece.over = Plane8::Zero(rows, columns);
    drafts[i].under.assign(drafts.size(), 0);
    for (int y = coarse.box.y0; y < coarse.box.y1; ++y)
      for (int x = coarse.box.x0; x < coarse.box.x1; ++x) {
        if (figure(y, x) == 0) continue;
        const int layer = labels(y, x);
        // At its root a limb and the body share what is drawn.
        bool root = false;
        for (const Limb& limb : limbs)
          root = root || ((i == 0 ? limb.layer == layer : limb.layer == piece.layer && layer == 0) &&
                          limb.root.holds(x, y));
        const bool behind = layer != piece.layer && coarse.at(hidden, x, y) != 0;
        if (layer != piece.layer && !root && !behind) continue;
        piece.mask(y, x) = 255;
        piece.hidden(y, x) = behind && !root;
        piece.over(y, x) = i > 0 && layer == piece.layer && !limbs[i - 1].root.holds(x, y);
        if (piece.hidden(y, x))
          for (std::size_t j = 1; j < drafts.size(); ++j) drafts[i].under[j] += limbs[j - 1].layer == layer;
      }
    const Plane8 inside = enclosed(piece.mask, figure);
    piece.hidden = piece.hidden.max(inside);
    piece.mask = (inside != 0).select(Plane8::Constant(rows, columns, 255), piece.mask);
    piece.hidden = (piece.mask != 0).select(grown(piece.hidden, soft), Plane8::Zero(rows, columns));
    keepLargest(piece.mask);
  }

  // What no piece shows any more goes to the one beside it.
  Plane8 bare = (figure != 0).cast<std::uint8_t>();
  for (const Draft& draft : drafts) bare = (draft.piece.mask != 0).select(Plane8::Zero(rows, columns), bare);
  for (bool any = (bare != 0).any(); any;) {
    any = false;
    for (Draft& draft : drafts) {
      Plane8 taken = (bare != 0 || draft.piece.mask != 0).cast<std::uint8_t>();
      keepLargest(taken);
      const Plane8 fresh = (taken != 0 && bare != 0).cast<std::uint8_t>();
      if (!(fresh != 0).any()) continue;
      any = true;
      draft.piece.mask = (fresh != 0).select(Plane8::Constant(rows, columns, 255), draft.piece.mask);
      bare = (fresh != 0).select(Plane8::Zero(rows, columns), bare);
    }
  }

  // The body, then what is hidden by others before those.
  std::vector<FigurePiece> pieces{std::move(drafts[0].piece)};
  std::vector<std::size_t> left;
  for (std::size_t i = 1; i < drafts.size(); ++i) left.push_back(i);
  while (!left.empty()) {
    const auto before = [&](std::size_t i) {
      return std::none_of(left.begin(), left.end(),
                          [&](std::size_t j) { return drafts[j].under[i] > drafts[i].under[j]; });
    };
    auto next = std::find_if(left.begin(), left.end(), before);
    if (next == left.end()) next = left.begin();
    pieces.push_back(std::move(drafts[*next].piece));
    left.erase(next);
  }
  for (FigurePiece& piece : pieces)
    for (Plane8* plane : {&piece.mask, &piece.hidden, &piece.over}) {
      Plane8 whole = Plane8::Zero(silhouette.mask.rows(), silhouette.mask.cols());
      whole.block(box.y0, box.x0, rows, columns) = *plane;
      *plane = std::move(whole);
    }
  return pieces;
}

std::vector<int> jointLayers(const Skeleton& skeleton, const SkeletonTemplate& body_plan,
                             const TriangleMesh& mesh) {
  std::vector<int> layers(skeleton.joints.size(), 0);
  for (std::size_t k = 0; k < body_plan.limbs.size(); ++k) {
    const int layer = static_cast<int>(k) + 1;
    if (!(mesh.layer.array() == layer).any()) continue;
    for (const int joint : body_plan.limbs[k].joints)
      if (const int found = skeleton.find(body_plan.joints[static_cast<std::size_t>(joint)].name); found >= 0)
        layers[static_cast<std::size_t>(found)] = layer;
  }
  return layers;
}

}  // namespace skel
