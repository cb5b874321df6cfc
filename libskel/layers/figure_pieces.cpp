// What others hide of a piece is its closing by a disc (J. Serra, "Image analysis and mathematical
// morphology", 1982) that is a little larger than they are thick, as far as they cover it: an arm before the
// chest has chest on both sides of it, one that hangs beside the body has not.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "libskel/candidates/candidates.h"
#include "libskel/core/segment.h"
#include "libskel/image/mask_parts.h"
#include "libskel/layers/layer_map.h"
#include "libskel/mesh/outline.h"

namespace skel {
namespace {

using Eigen::Vector2d;

constexpr int kCoarse = 200;           // px, the long side of the figure when hidden parts are looked for
constexpr double kThicker = 1.3;       // than half of what hides: the disc of the closing
constexpr double kLeastPiece = 0.004;  // of the figure: less is no limb

PixelBox common(const PixelBox& a, const PixelBox& b) {
  const PixelBox box{std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
  return box.width() > 0 && box.height() > 0 ? box : PixelBox{};
}

PixelBox around(const PixelBox& a, const PixelBox& b) {
  if (a.width() == 0 || b.width() == 0) return a.width() == 0 ? b : a;
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

PixelBox widened(const PixelBox& box, int by) { return {box.x0 - by, box.y0 - by, box.x1 + by, box.y1 + by}; }

auto within(Plane8& plane, const PixelBox& box) {
  return plane.block(box.y0, box.x0, box.height(), box.width());
}
auto within(const Plane8& plane, const PixelBox& box) {
  return plane.block(box.y0, box.x0, box.height(), box.width());
}

// A plane at every n-th pixel of a box.
struct Coarse {
  PixelBox box;
  int step = 1;

  Plane8 shrink(const Plane8& plane) const {
    const int rows = (box.height() + step - 1) / step, columns = (box.width() + step - 1) / step;
    Plane8 small(rows, columns);
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x)
        small(y, x) = plane(std::min(box.y0 + y * step + step / 2, box.y1 - 1),
                            std::min(box.x0 + x * step + step / 2, box.x1 - 1));
    return small;
  }
  std::uint8_t at(const Plane8& small, int x, int y) const {
    return small((y - box.y0) / step, (x - box.x0) / step);
  }
};

// Within `wanted` alone, where it is that of the whole mask.
Plane8 closing(const Plane8& mask, double radius, const PixelBox& wanted) {
  const PixelBox whole{0, 0, static_cast<int>(mask.cols()), static_cast<int>(mask.rows())};
  const int reach = 2 * static_cast<int>(std::ceil(radius)) + 2;
  const PixelBox room = widened(wanted, reach), seen = common(room, whole);
  Plane8 near = Plane8::Ones(room.height(), room.width());
  near.block(seen.y0 - room.y0, seen.x0 - room.x0, seen.height(), seen.width()) =
      (within(mask, seen) == 0).cast<std::uint8_t>();
  near = (distanceField(near) <= static_cast<float>(radius)).cast<std::uint8_t>();
  near = (distanceField(near) > static_cast<float>(radius)).cast<std::uint8_t>();
  Plane8 closed = Plane8::Zero(mask.rows(), mask.cols());
  within(closed, wanted) = near.block(reach, reach, wanted.height(), wanted.width());
  return closed;
}

// All but the largest 4-connected part go.
void keepLargest(Plane8& mask) {
  const MaskParts parts = maskParts(mask);
  const int largest = parts.largest();
  for (const MaskParts::Run& run : parts.runs)
    if (run.part != largest) mask.row(run.y).segment(run.x0, run.x1 - run.x0).setZero();
}

// 1 where the mask encloses what it does not hold all round. `figure`: of its size, not 0 on the figure.
Plane8 enclosed(const Plane8& mask, const Plane8& figure) {
  const Plane8 others = (figure != 0 && mask == 0).cast<std::uint8_t>();
  const MaskParts parts = maskParts(others);
  std::vector<char> open(parts.size.size(), 0);
  const auto rows = static_cast<int>(mask.rows()), columns = static_cast<int>(mask.cols());
  for (const MaskParts::Run& run : parts.runs) {
    if (open[run.part]) continue;
    open[run.part] = run.x0 == 0 || run.x1 == columns || run.y == 0 || run.y + 1 == rows ||
                     figure(run.y, run.x0 - 1) == 0 || figure(run.y, run.x1) == 0 ||
                     (figure.row(run.y - 1).segment(run.x0, run.x1 - run.x0) == 0).any() ||
                     (figure.row(run.y + 1).segment(run.x0, run.x1 - run.x0) == 0).any();
  }
  Plane8 inside = Plane8::Zero(rows, columns);
  for (const MaskParts::Run& run : parts.runs)
    if (!open[run.part]) inside.row(run.y).segment(run.x0, run.x1 - run.x0).setOnes();
  return inside;
}

// The pixels of a mask of 0 and 1 and those up to `reach` away from them each way.
void grow(Plane8& mask, int reach) {
  const PixelBox whole{0, 0, static_cast<int>(mask.cols()), static_cast<int>(mask.rows())};
  const PixelBox box = figureBox(mask);
  if (box.width() == 0) return;
  const PixelBox wide = common(widened(box, reach), whole);
  Plane8 rows = Plane8::Zero(mask.rows(), mask.cols());
  for (int y = box.y0; y < box.y1; ++y)
    for (int x = box.x0; x < box.x1; ++x) {
      if (mask(y, x) == 0) continue;
      const int first = x;
      while (x < box.x1 && mask(y, x) != 0) ++x;
      const int x0 = std::max(0, first - reach), x1 = std::min(whole.x1, x + reach);
      rows.row(y).segment(x0, x1 - x0).setOnes();
    }
  for (int y = wide.y0; y < wide.y1; ++y) {
    auto grown = mask.row(y).segment(wide.x0, wide.width());
    for (int v = std::max(y - reach, box.y0); v <= std::min(y + reach, box.y1 - 1); ++v)
      grown = grown.max(rows.row(v).segment(wide.x0, wide.width()));
  }
}

// What a limb shares with the trunk: around its first joint, and on, along its bones, to where it is seen.
struct Root {
  Vector2d from, by, to;
  double radius = 0;  // px
  bool holds(int x, int y) const {
    const Vector2d p(x, y);
    return std::min(distanceToSegment<Vector2d>(p, from, by), distanceToSegment<Vector2d>(p, by, to)) <=
           radius;
  }
  PixelBox box() const {
    const auto at = [&](const Vector2d& p) {
      const auto reach = static_cast<int>(std::ceil(radius)) + 1;
      const auto x = static_cast<int>(std::lround(p.x())), y = static_cast<int>(std::lround(p.y()));
      return PixelBox{x - reach, y - reach, x + reach + 1, y + reach + 1};
    };
    return around(around(at(from), at(by)), at(to));
  }
};

struct Limb {
  int layer = 0;
  PixelBox box;
  double half_px = 0;  // of its width where it is widest
  Root root;
  bool far = false;
};

// From the first joint to where the limb begins to be seen on its bones. As wide as half of the limb from
// there on: the median, along half of a bone, of the largest discs that fit in beside it. `inside`: of the
// limb's coarse mask.
Root rootOf(const Coarse& coarse, const DistanceField& inside, const std::array<Vector2d, 3>& joints) {
  constexpr int kSteps = 20;  // a bone
  constexpr std::size_t kEnd = 2 * kSteps;
  std::array<Vector2d, kEnd + 1> bones;
  for (std::size_t i = 0; i <= kEnd; ++i) {
    const std::size_t bone = i < kSteps ? 0 : 1;
    bones[i] = joints[bone] + (double(i) / kSteps - double(bone)) * (joints[bone + 1] - joints[bone]);
  }
  // Of each pixel, to the step that is nearest: how wide the limb is there, and whether it is seen on the
  // bone.
  const double near = std::max(double(coarse.step), .1 * (joints[1] - joints[0]).norm());
  std::array<float, kEnd + 1> widest{};
  std::size_t seen = kEnd;
  for (int v = 0; v < inside.rows(); ++v)
    for (int u = 0; u < inside.cols(); ++u) {
      if (inside(v, u) == 0) continue;
      const Vector2d p(coarse.box.x0 + (u + .5) * coarse.step, coarse.box.y0 + (v + .5) * coarse.step);
      std::size_t nearest = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < bones.size(); ++i)
        if (const double d = (bones[i] - p).squaredNorm(); d < least) least = d, nearest = i;
      widest[nearest] = std::max(widest[nearest], inside(v, u));
      if (std::sqrt(least) <= near) seen = std::min(seen, nearest);
    }
  const auto first = widest.begin() + std::ptrdiff_t(std::max<std::size_t>(seen, kSteps / 4));
  std::vector<float> radii;
  std::copy_if(first, std::min(first + kSteps / 2, widest.end()), std::back_inserter(radii),
               [](float radius) { return radius > 0; });
  if (radii.empty()) radii.push_back(inside.maxCoeff());
  std::nth_element(radii.begin(), radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2), radii.end());
  return {joints[0], bones[std::min<std::size_t>(seen, kSteps)], bones[seen],
          static_cast<double>(radii[radii.size() / 2]) * coarse.step};
}

// Of each number in the plane, the pixels that have it.
std::array<PixelBox, 256> boxesOf(const Plane8& labels, const PixelBox& figure) {
  std::array<PixelBox, 256> boxes;
  for (int y = figure.y0; y < figure.y1; ++y)
    for (int x = figure.x0; x < figure.x1;) {
      const std::uint8_t label = labels(y, x);
      const int first = x;
      while (x < figure.x1 && labels(y, x) == label) ++x;
      if (label != 0) boxes[label] = around(boxes[label], {first, y, x, y + 1});
    }
  return boxes;
}

struct Draft {
  FigurePiece piece;
  std::vector<std::int64_t> under;  // of each draft: how many pixels of it hide this one
};

void enlarge(FigurePiece& piece, const PixelBox& box) {
  const PixelBox wide = around(piece.box, box);
  for (Plane8* plane : {&piece.mask, &piece.hidden, &piece.over}) {
    Plane8 whole = Plane8::Zero(wide.height(), wide.width());
    whole.block(piece.box.y0 - wide.y0, piece.box.x0 - wide.x0, plane->rows(), plane->cols()) = *plane;
    *plane = std::move(whole);
  }
  piece.box = wide;
}

// What no piece shows goes to the first that is beside it.
void giveAway(const Plane8& figure, const PixelBox& box, std::vector<Draft>& drafts) {
  Plane8 bare = (within(figure, box) != 0).cast<std::uint8_t>();
  for (const Draft& draft : drafts) {
    const PixelBox& own = draft.piece.box;
    for (int v = 0; v < own.height(); ++v) {
      const std::uint8_t* shown = draft.piece.mask.row(v).data();
      std::uint8_t* there = &bare(own.y0 - box.y0 + v, own.x0 - box.x0);
      for (int u = 0; u < own.width(); ++u) there[u] &= std::uint8_t(shown[u] == 0);
    }
  }
  const MaskParts parts = maskParts(bare);
  std::vector<std::vector<MaskParts::Run>> runs_of(parts.size.size());
  for (const MaskParts::Run& run : parts.runs) runs_of[static_cast<std::size_t>(run.part)].push_back(run);
  for (const std::vector<MaskParts::Run>& runs : runs_of) {
    const auto beside = [&](const Draft& draft) {
      const PixelBox& own = draft.piece.box;
      const auto shows = [&](int x, int y) {
        const int u = x + box.x0 - own.x0, v = y + box.y0 - own.y0;
        return u >= 0 && v >= 0 && u < own.width() && v < own.height() && draft.piece.mask(v, u) != 0;
      };
      for (const MaskParts::Run& run : runs) {
        if (shows(run.x0 - 1, run.y) || shows(run.x1, run.y)) return true;
        for (int x = run.x0; x < run.x1; ++x)
          if (shows(x, run.y - 1) || shows(x, run.y + 1)) return true;
      }
      return false;
    };
    const auto taker = std::find_if(drafts.begin(), drafts.end(), beside);
    if (taker == drafts.end()) continue;
    FigurePiece& piece = taker->piece;
    for (const MaskParts::Run& run : runs) {
      const PixelBox there{run.x0 + box.x0, run.y + box.y0, run.x1 + box.x0, run.y + box.y0 + 1};
      const PixelBox in_both = common(there, piece.box);
      if (in_both.width() < there.width()) enlarge(piece, there);
      piece.mask.row(there.y0 - piece.box.y0)
          .segment(there.x0 - piece.box.x0, there.width())
          .setConstant(255);
    }
  }
}

}  // namespace

int loosePixels(const LayerMap& layers, int limb, const Plane8& found) {
  if (!layers.any()) return 0;
  const MaskParts parts = maskParts((layers.limb == std::uint8_t(limb)).cast<std::uint8_t>());
  const int largest = parts.largest();
  int loose = 0;
  for (const MaskParts::Run& run : parts.runs)
    if (run.part != largest)
      for (int x = run.x0; x < run.x1; ++x) loose += found.size() == 0 || found(run.y, x) != limb;
  return loose;
}

std::vector<FigurePiece> figurePieces(const LayerMap& layers, const Silhouette& silhouette,
                                      const Skeleton& skeleton, const SkeletonTemplate& body_plan) {
  if (!layers.any()) return {};
  const Plane8& figure = silhouette.mask;
  const PixelBox box = figureBox(figure);
  const int long_side = std::max(box.width(), box.height()), step = std::max(1, long_side / kCoarse);
  const auto figure_px = static_cast<double>((within(figure, box) != 0).count());
  Plane8 labels = layers.limb;

  // A limb is one part of its pixels; what is apart belongs to the body.
  std::vector<Limb> limbs;
  const std::array<PixelBox, 256> boxes = boxesOf(labels, box);
  for (std::size_t k = 0; k < body_plan.limbs.size(); ++k) {
    const int layer = static_cast<int>(k) + 1;
    const PixelBox& own = boxes[static_cast<std::size_t>(layer)];
    if (own.width() == 0) continue;
    Plane8 limb = (within(labels, own) == static_cast<std::uint8_t>(layer)).cast<std::uint8_t>();
    const Plane8 all = limb;
    keepLargest(limb);
    const auto jointAt = [&](int i) -> std::optional<Vector2d> {
      const auto of_plan = static_cast<std::size_t>(body_plan.limbs[k].joints[static_cast<std::size_t>(i)]);
      const int joint = skeleton.find(body_plan.joints[of_plan].name);
      if (joint < 0) return std::nullopt;
      return skeleton.joints[static_cast<std::size_t>(joint)].image;
    };
    const std::optional<Vector2d> from = jointAt(0), by = jointAt(1), to = jointAt(2);
    if (!(static_cast<double>((limb != 0).count()) >= kLeastPiece * figure_px && from && by && to))
      limb.setZero();
    within(labels, own) =
        Plane8((all != limb).select(Plane8::Zero(limb.rows(), limb.cols()), within(labels, own)));
    if (!limb.any()) continue;
    const Coarse coarse{{0, 0, own.width(), own.height()}, step};
    const DistanceField inside = distanceField(coarse.shrink(limb));
    const Vector2d corner(own.x0, own.y0);
    const bool far = std::find(layers.far.begin(), layers.far.end(), layer) != layers.far.end();
    Root root = rootOf(coarse, inside, {*from - corner, *by - corner, *to - corner});
    root.from += corner, root.by += corner, root.to += corner;
    limbs.push_back({layer, own, static_cast<double>(inside.maxCoeff()) * step, root, far});
  }
  if (limbs.empty()) return {};

  const Coarse coarse{box, step};
  const Plane8 small = coarse.shrink(labels), small_figure = coarse.shrink(figure);
  const auto hiddenOf = [&](int layer) {
    double half = 0;
    for (const Limb& limb : limbs)
      if (limb.layer != layer) half = std::max(half, limb.half_px);
    const Plane8 own =
        ((small == static_cast<std::uint8_t>(layer)) && (small_figure != 0)).cast<std::uint8_t>();
    // A closing stays within the convex hull.
    const PixelBox hull = figureBox(own);
    Plane8 others = Plane8::Zero(own.rows(), own.cols());
    within(others, hull) =
        (within(small, hull) != 0 && within(small, hull) != static_cast<std::uint8_t>(layer))
            .cast<std::uint8_t>();
    const PixelBox wanted = figureBox(others);
    if (half == 0 || wanted.width() == 0) return Plane8(Plane8::Zero(own.rows(), own.cols()));
    return Plane8(
        (closing(own, kThicker * half / step + 1, wanted) != 0 && others != 0).cast<std::uint8_t>());
  };

  std::vector<Draft> drafts(limbs.size() + 1);
  const int soft = std::max(2, static_cast<int>(std::lround(0.006 * long_side)));
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    FigurePiece& piece = drafts[i].piece;
    piece.layer = i == 0 ? 0 : limbs[i - 1].layer;
    piece.behind = i > 0 && limbs[i - 1].far;
    piece.box = i == 0 ? box : common(around(limbs[i - 1].box, limbs[i - 1].root.box()), box);
    const Plane8 hidden = hiddenOf(piece.layer);
    piece.mask = piece.hidden = piece.over = Plane8::Zero(piece.box.height(), piece.box.width());
    std::array<std::int64_t, 256> over{};
    for (int y = piece.box.y0; y < piece.box.y1; ++y)
      for (int x = piece.box.x0; x < piece.box.x1; ++x) {
        if (figure(y, x) == 0) continue;
        const int layer = labels(y, x), u = x - piece.box.x0, v = y - piece.box.y0;
        if (layer == piece.layer) {
          piece.mask(v, u) = 255;
          piece.over(v, u) = i > 0 && !limbs[i - 1].root.holds(x, y);
          continue;
        }
        // At its root a limb and the body share what is drawn; of a far one all that lies there hides it.
        const int rooted = piece.behind || layer == 0 ? piece.layer : layer;
        const Limb& limb =
            *std::find_if(limbs.begin(), limbs.end(), [&](const Limb& l) { return l.layer == rooted; });
        const bool root = limb.root.holds(x, y), bare = i == 0 && limb.far;
        if (root && (i == 0 || layer == 0) && !limb.far) {
          piece.mask(v, u) = 255;
        } else if ((root && piece.behind) || (layer != 0 && !bare && coarse.at(hidden, x, y) != 0)) {
          piece.mask(v, u) = 255;
          piece.hidden(v, u) = 1;
          ++over[static_cast<std::size_t>(layer)];
        }
      }
    drafts[i].under.assign(drafts.size(), 0);
    for (std::size_t j = 1; j < drafts.size(); ++j)
      drafts[i].under[j] = over[static_cast<std::size_t>(limbs[j - 1].layer)];
    const Plane8 inside = enclosed(piece.mask, within(figure, piece.box));
    piece.hidden = piece.hidden.max(inside);
    piece.mask = (inside != 0).select(Plane8::Constant(inside.rows(), inside.cols(), 255), piece.mask);
    grow(piece.hidden, soft);
    piece.hidden = (piece.mask != 0).select(piece.hidden, Plane8::Zero(piece.mask.rows(), piece.mask.cols()));
    keepLargest(piece.mask);
  }
  giveAway(figure, box, drafts);

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
  return pieces;
}

std::vector<int> jointLayers(const Skeleton& skeleton, const SkeletonTemplate& body_plan,
                             const TriangleMesh& mesh, const LayerMap& map) {
  std::vector<int> layers(skeleton.joints.size(), 0);
  for (std::size_t k = 0; k < body_plan.limbs.size(); ++k) {
    const int limb = static_cast<int>(k) + 1;
    const bool hidden = std::find(map.hidden.begin(), map.hidden.end(), limb) != map.hidden.end();
    if (!hidden && !(mesh.layer.array() == limb).any()) continue;
    for (const int joint : body_plan.limbs[k].joints)
      if (const int found = skeleton.find(body_plan.joints[static_cast<std::size_t>(joint)].name); found >= 0)
        layers[static_cast<std::size_t>(found)] = hidden ? -1 : limb;
  }
  return layers;
}

}  // namespace skel
