#include "trainer/figures/figure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

#include "libskel/image/mask_parts.h"
#include "libskel/jointnet/figure_look.h"
#include "libskel/jointnet/net_joints.h"
#include "libskel/silhouette/pieces.h"
#include "trainer/figures/biped_plan.h"
#include "trainer/figures/pasted_drawing.h"
#include "trainer/figures/repaint.h"
#include "trainer/figures/warped_drawing.h"

namespace skel {
namespace {

using Vec = Eigen::Vector2d;

constexpr int kLongSide = 128;    // of the finished mask
constexpr int kOversampling = 2;  // raster px per grid px
constexpr int kMargin = 12;       // raster px around the scene, for what the finish adds

using Bits = std::vector<std::uint8_t>;

// A slight or sometimes strong turn, stretch and shear, and sometimes a soft bending of the plane.
std::function<Vec(const Vec&)> sampleWarp(Rng& rng) {
  const double angle = rng.normal(0, rng.chance(.9) ? .06 : .4);
  const double sx = std::exp(rng.normal(0, .1)), sy = std::exp(rng.normal(0, .1)), shear = rng.normal(0, .05);
  Eigen::Matrix2d linear;
  linear << sx, shear, 0, sy;
  linear = Eigen::Rotation2Dd(angle).toRotationMatrix() * linear;
  struct Wave {
    Vec direction, shift;
    double phase;
  };
  std::array<Wave, 4> waves{};
  if (rng.chance(.4)) {
    const double size = rng.uniform(.003, .02);
    for (Wave& w : waves) {
      w.direction = rotated(Vec(rng.uniform(3, 14), 0), rng.uniform(0, 2 * std::numbers::pi));
      w.shift = Vec(rng.normal(0, size), rng.normal(0, size));
      w.phase = rng.uniform(0, 2 * std::numbers::pi);
    }
  }
  return [=](const Vec& p) -> Vec {
    Vec q = linear * p;
    for (const Wave& w : waves) {
      if (!w.shift.isZero()) q += w.shift * std::sin(w.direction.dot(p) + w.phase);
    }
    return q;
  };
}

// Mean over a (2·radius + 1)² window, twice: close to a Gaussian.
void blur(std::vector<float>& plane, int width, int height, int radius) {
  std::vector<float> line(std::max(width, height));
  const auto pass = [&](float* first, int count, int stride) {
    for (int i = 0; i < count; ++i) line[i] = first[i * stride];
    float sum = 0;
    for (int i = -radius; i <= radius; ++i) sum += line[std::clamp(i, 0, count - 1)];
    for (int i = 0; i < count; ++i) {
      first[i * stride] = sum / (2 * radius + 1);
      sum += line[std::min(i + radius + 1, count - 1)] - line[std::max(i - radius, 0)];
    }
  };
  for (int round = 0; round < 2; ++round) {
    for (int y = 0; y < height; ++y) pass(plane.data() + y * width, width, 1);
    for (int x = 0; x < width; ++x) pass(plane.data() + x, height, width);
  }
}

// Outline made ragged (noise > 0) or rounder.
void roughen(Rng& rng, Bits& solid, int width, int height, int radius, double noise) {
  std::vector<float> plane(solid.begin(), solid.end());
  blur(plane, width, height, radius);
  if (noise > 0) {
    const int cell = 2 + rng.below(8);
    const int columns = width / cell + 2, rows = height / cell + 2;
    std::vector<float> lattice(static_cast<std::size_t>(columns) * rows);
    for (float& v : lattice) v = static_cast<float>(noise * rng.normal());
    for (int y = 0; y < height; ++y) {
      const float fy = static_cast<float>(y) / cell;
      const int j = static_cast<int>(fy);
      for (int x = 0; x < width; ++x) {
        const float fx = static_cast<float>(x) / cell;
        const int i = static_cast<int>(fx);
        const float* l = &lattice[j * columns + i];
        const float upper = l[0] + (l[1] - l[0]) * (fx - i),
                    lower = l[columns] + (l[columns + 1] - l[columns]) * (fx - i);
        plane[y * width + x] += upper + (lower - upper) * (fy - j);
      }
    }
  }
  for (std::size_t i = 0; i < solid.size(); ++i) solid[i] = plane[i] > .5f;
}

// Grows (or, with value 0, shrinks) by a diamond of the given radius.
void grow(Bits& solid, int width, int height, int radius, std::uint8_t value) {
  for (int step = 0; step < radius; ++step) {
    const Bits before = solid;
    for (int y = 1; y + 1 < height; ++y) {
      for (int x = 1; x + 1 < width; ++x) {
        const int i = y * width + x;
        if (before[i - 1] == value || before[i + 1] == value || before[i - width] == value ||
            before[i + width] == value) {
          solid[i] = value;
        }
      }
    }
  }
}

// The 4-connected parts of the pixels that have this value.
MaskParts partsWith(std::uint8_t value, const Bits& plane, int width, int height) {
  const Eigen::Map<const Plane8> all(plane.data(), height, width);
  return maskParts((all == value).cast<std::uint8_t>());
}

void setRun(Bits& plane, int width, const MaskParts::Run& run, std::uint8_t value) {
  std::fill_n(plane.begin() + static_cast<std::ptrdiff_t>(run.y) * width + run.x0, run.x1 - run.x0, value);
}

void fillHoles(Bits& solid, int width, int height) {
  const MaskParts parts = partsWith(0, solid, width, height);
  std::vector<bool> outside(parts.size.size(), false);
  for (const MaskParts::Run& run : parts.runs) {
    if (run.y == 0 || run.y == height - 1 || run.x0 == 0 || run.x1 == width) outside[run.part] = true;
  }
  for (const MaskParts::Run& run : parts.runs) {
    if (!outside[run.part]) setRun(solid, width, run, 1);
  }
}

// Keeps the largest part; returns its share of all that was there.
double keepLargestPart(Bits& solid, int width, int height) {
  const MaskParts parts = partsWith(1, solid, width, height);
  const int largest = parts.largest();
  if (largest < 0) return 0;
  for (const MaskParts::Run& run : parts.runs) {
    if (run.part != largest) setRun(solid, width, run, 0);
  }
  const auto all = std::accumulate(parts.size.begin(), parts.size.end(), std::int64_t{0});
  return static_cast<double>(parts.size[largest]) / static_cast<double>(all);
}

// Joins the pieces of a figure as the silhouette stage does; returns the figure's share of all that was
// there.
double joinFigure(Bits& solid, int width, int height) {
  const Eigen::Map<const Plane8> before(solid.data(), height, width);
  PieceOptions options;
  options.widest_gap = .16;
  options.leave_ground = false;
  const std::vector<JoinedFigure> figures = joinPieces(before, 8, options);
  if (figures.empty()) return 0;
  const Plane8 mask = figures.front().inPicture(figures.front().mask, height, width);
  double all = 0, kept = 0;
  for (std::size_t i = 0; i < solid.size(); ++i) {
    all += solid[i] != 0;
    kept += solid[i] != 0 && mask.data()[i] != 0;
    solid[i] = mask.data()[i] != 0;
  }
  return kept / all;
}

// Gaps across limbs and neck, as in pictograms, jointed dolls and careless lines.
void cutGaps(Rng& rng, Bits& solid, int width, int height, const std::vector<Vec>& joints,
             const NetJoints& tree) {
  const bool everywhere = rng.chance(.25);
  for (int j = 0; j < tree.count(); ++j) {
    if (tree.parent[j] < 0 || !rng.chance(everywhere ? .6 : .12)) continue;
    const Vec &a = joints[tree.parent[j]], &b = joints[j];
    if ((b - a).norm() < 4) continue;
    const Vec n = (b - a).normalized(), at = a + (b - a) * rng.uniform(.1, .9);
    const double half = rng.uniform(.7, 4.5), reach = rng.uniform(12, 40);
    const int x0 = std::max(0, static_cast<int>(at.x() - reach)),
              x1 = std::min(width - 1, static_cast<int>(at.x() + reach));
    const int y0 = std::max(0, static_cast<int>(at.y() - reach)),
              y1 = std::min(height - 1, static_cast<int>(at.y() + reach));
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const Vec d = Vec(x, y) - at;
        if (std::abs(d.dot(n)) <= half && d.norm() <= reach) solid[y * width + x] = 0;
      }
    }
  }
}

// What lies under or behind a figure and is taken for a part of it: a shadow, a line of ground, a sun,
// letters.
Scene sampleJunk(Rng& rng, const Scene& figure) {
  const Scene::Box box = figure.box();
  const Vec size = box.high - box.low, middle = (box.low + box.high) / 2;
  const double unit = size.maxCoeff();
  const auto grey = static_cast<std::uint8_t>(rng.uniform(30, 220));
  Ink ink;
  ink.fill = rng.chance(.6) ? Colour{grey, grey, grey}
                            : Colour{static_cast<std::uint8_t>(rng.uniform(60, 250)),
                                     static_cast<std::uint8_t>(rng.uniform(60, 250)),
                                     static_cast<std::uint8_t>(rng.uniform(60, 250))};
  Scene junk;
  junk.begin(ink);
  const double kind = rng.uniform();
  if (kind < .5) {  // shadow
    const double half = size.x() * rng.uniform(.25, .75);
    junk.ellipse({middle.x() + rng.normal(0, .25) * size.x(), box.high.y() - unit * rng.uniform(-.01, .04)},
                 {half, half * rng.uniform(.08, .3)}, rng.chance(.8) ? 0 : rng.normal(0, .3));
  } else if (kind < .68) {  // ground
    const double half = size.x() * rng.uniform(.4, 1.1), r = unit * rng.uniform(.004, .02);
    const Vec at(middle.x() + rng.normal(0, .2) * size.x(), box.high.y() - r);
    junk.line(at - Vec(half, 0), at + Vec(half, rng.normal(0, .02) * unit), r, r);
  } else if (kind < .82) {  // sun, cloud, smear
    const int discs = 1 + static_cast<int>(rng.below(3));
    Vec at = middle + Vec(rng.normal(0, .35) * size.x(), rng.normal(0, .25) * size.y());
    for (int i = 0; i < discs; ++i) {
      junk.ellipse(at, Vec(rng.uniform(.1, .32), rng.uniform(.1, .32)) * unit, 0);
      at += Vec(rng.normal(0, .15), rng.normal(0, .1)) * unit;
    }
  } else {  // letters
    const int letters = 2 + static_cast<int>(rng.below(5));
    const double tall = unit * rng.uniform(.05, .16), side = rng.chance(.5) ? 1 : -1;
    Vec at(side > 0 ? box.high.x() : box.low.x(), box.low.y() + size.y() * rng.uniform(.05, .9));
    at.x() -= side * size.x() * rng.uniform(.05, .3);
    for (int i = 0; i < letters; ++i) {
      const double wide = tall * rng.uniform(.5, 1);
      junk.ellipse(at, {wide * .55, tall * .5}, rng.normal(0, .1), rng.uniform(2, 8));
      at.x() += side * wide;
    }
  }
  return junk;
}

Drawing drawFigure(Rng& rng, const FigurePlan& plan, const FigureOptions& options) {
  Drawing drawing = plan.draw(rng, sampleKind(rng, plan, options.kinds));
  const auto warp = sampleWarp(rng);
  drawing.scene.transform(warp);
  for (Vec& p : drawing.joints) p = warp(p);
  return drawing;
}

// Two figures that touch, or one with another being or a thing as large as itself.
Drawing drawPair(Rng& rng, const FigurePlan& plan, const FigureOptions& options) {
  Drawing a = drawFigure(rng, plan, options);
  Scene b = rng.chance(.6) ? drawFigure(rng, plan, options).scene : plan.drawOther(rng);
  const Scene::Box box_a = a.scene.box(), box_b = b.box();
  const double scale =
      (box_a.high - box_a.low).maxCoeff() / (box_b.high - box_b.low).maxCoeff() * rng.uniform(.7, 1.2);
  const bool beside = rng.chance(.75);
  const double overlap = rng.uniform(.05, .4);
  const Vec size_a = box_a.high - box_a.low, size_b = (box_b.high - box_b.low) * scale;
  Vec shift;
  if (beside) {
    shift = {box_a.low.x() + size_a.x() - overlap * std::min(size_a.x(), size_b.x()),
             box_a.high.y() - size_b.y() + rng.normal(0, .1)};
  } else {
    shift = {box_a.low.x() + rng.normal(0, .2), box_a.high.y() - overlap * size_b.y()};
  }
  b.transform([&](const Vec& p) { return Vec((p - box_b.low) * scale + shift); });
  a.scene.append(b);
  a.whole = false;
  return a;
}

enum class Cut { kNone, kSlight, kHeavy };

// Where a cut through the picture leaves the figure, in raster px.
struct Window {
  int x0, y0, x1, y1;  // x1, y1 excluded
};

Window sampleWindow(Rng& rng, Cut cut, int width, int height) {
  Window w{0, 0, width, height};
  if (cut == Cut::kNone) return w;
  const double share = cut == Cut::kSlight ? rng.uniform(.01, .05) : rng.uniform(.3, .6);
  const double r = rng.uniform();
  const int dx = static_cast<int>((width - 2 * kMargin) * share) + kMargin;
  const int dy = static_cast<int>((height - 2 * kMargin) * share) + kMargin;
  if (r < .5) {
    w.y1 = height - dy;
  } else if (r < .65) {
    w.y0 = dy;
  } else if (r < .82) {
    w.x0 = dx;
  } else {
    w.x1 = width - dx;
  }
  return w;
}

// By the template, made once.
const NetJoints& jointsOf(const FigurePlan& plan) {
  static const auto all = [] {
    std::map<std::string_view, NetJoints> joints;
    for (const FigurePlan& p : figurePlans())
      joints.emplace(p.body_plan, netJoints(jointNames(p), loadTemplate(std::string(p.body_plan))));
    return joints;
  }();
  return all.at(plan.body_plan);
}

void sortSides(Figure& figure, const NetJoints& joints) {
  for (const std::vector<int>& limb : joints.limbs) {
    double x_left = 0, x_right = 0;
    for (const int k : limb) {
      x_left += figure.joints[k].x();
      x_right += figure.joints[joints.mirrored[k]].x();
    }
    if (x_right <= x_left) continue;
    for (const int k : limb) {
      const int other = joints.mirrored[k];
      std::swap(figure.joints[k], figure.joints[other]);
      std::vector<bool>::swap(figure.visible[k], figure.visible[other]);
      std::vector<bool>::swap(figure.absent[k], figure.absent[other]);
      std::vector<bool>::swap(figure.unknown[k], figure.unknown[other]);
    }
  }
}

// Whether hands and feet are still there, and not everything is hidden behind a hat or a shield.
bool isReadable(const Figure& figure, const FigurePlan& plan) {
  constexpr double kLeastVisible = .42;
  constexpr int kReach = 6;
  for (std::size_t j = 0; j < plan.joints.size(); ++j) {
    if (!plan.joints[j].end || figure.absent[j] || figure.unknown[j]) continue;
    const int x = static_cast<int>(std::lround(figure.joints[j].x())),
              y = static_cast<int>(std::lround(figure.joints[j].y()));
    const int x0 = std::max(0, x - kReach),
              x1 = std::min<int>(static_cast<int>(figure.mask.cols()), x + kReach + 1);
    const int y0 = std::max(0, y - kReach),
              y1 = std::min<int>(static_cast<int>(figure.mask.rows()), y + kReach + 1);
    if (x0 >= x1 || y0 >= y1 || (figure.mask.block(y0, x0, y1 - y0, x1 - x0) == 0).all()) return false;
  }
  return static_cast<double>(std::count(figure.visible.begin(), figure.visible.end(), true)) >=
         kLeastVisible * static_cast<double>(plan.joints.size());
}

// A figure in raster px (corner of the first at 0), before what pen, paper and scanner do to it.
struct Canvas {
  int width, height;
  Bits solid;
  std::function<Colour(int x, int y)> colour;
  std::vector<Vec> joints;
  std::vector<bool> visible, absent, unknown;
  FigureView view;
  int kind;
  bool whole;
};

// Darker towards the outline and away from the light, as if the figure was round.
void shadeRound(Rng& rng, GridColours& colours, const Bits& grid, int columns, int rows) {
  const int depth = 3 + static_cast<int>(rng.below(8));
  std::vector<float> inner(grid.begin(), grid.end());
  blur(inner, columns, rows, depth);
  const double angle = rng.uniform(0, 2 * std::numbers::pi);
  const auto strength = static_cast<float>(rng.uniform(.3, .8)),
             slant = static_cast<float>(rng.uniform(0, 3));
  const int dx = static_cast<int>(std::lround(2 * std::cos(angle))),
            dy = static_cast<int>(std::lround(2 * std::sin(angle)));
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const auto at = [&](int v, int u) {
        return inner[std::clamp(v, 0, rows - 1) * columns + std::clamp(u, 0, columns - 1)];
      };
      const float shade =
          1 - strength * (1 - at(y, x)) + slant * strength * (at(y + dy, x + dx) - at(y - dy, x - dx));
      auto colour = colours.row(y * columns + x);
      colour = (colour * std::clamp(shade, .2f, 1.6f)).min(255.f);
    }
  }
}

std::optional<Figure> finished(Rng& rng, const FigurePlan& plan, Canvas canvas, Cut cut) {
  const auto [width, height] = std::pair(canvas.width, canvas.height);
  Bits& solid = canvas.solid;
  const double finish = rng.uniform();
  if (finish < .28) {
    roughen(rng, solid, width, height, 1 + rng.below(3), rng.uniform(.05, .4));
  } else if (finish < .45) {
    roughen(rng, solid, width, height, 1 + rng.below(4), 0);
  }
  const double thickness = rng.uniform();
  if (thickness < .14) {
    grow(solid, width, height, 1 + rng.below(3), 1);
  } else if (thickness < .32) {
    const int radius = 1 + rng.below(6);
    grow(solid, width, height, radius, 1);
    grow(solid, width, height, radius, 0);
  } else if (thickness < .36) {
    grow(solid, width, height, 1, 0);
  }
  const Window window = sampleWindow(rng, cut, width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (x < window.x0 || x >= window.x1 || y < window.y0 || y >= window.y1) solid[y * width + x] = 0;
    }
  }
  if (canvas.whole && rng.chance(.1)) cutGaps(rng, solid, width, height, canvas.joints, jointsOf(plan));
  const double kept = canvas.whole ? joinFigure(solid, width, height) : keepLargestPart(solid, width, height);
  if (kept < (canvas.whole ? .85 : .5)) return std::nullopt;
  if (rng.chance(.5)) fillHoles(solid, width, height);

  // The box of what is left, in raster px.
  int x0 = width, y0 = height, x1 = -1, y1 = -1;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!solid[y * width + x]) continue;
      x0 = std::min(x0, x), x1 = std::max(x1, x);
      y0 = std::min(y0, y), y1 = std::max(y1, y);
    }
  }
  // The grid's px as areas of the raster: the finish may have changed the size by a few px.
  const double step = static_cast<double>(std::max(x1 - x0, y1 - y0) + 1) / kLongSide;
  const int columns = std::clamp(static_cast<int>(std::lround((x1 - x0 + 1) / step)), 1, kLongSide);
  const int rows = std::clamp(static_cast<int>(std::lround((y1 - y0 + 1) / step)), 1, kLongSide);

  Bits grid(static_cast<std::size_t>(columns) * rows, 0);
  GridColours colours = GridColours::Constant(columns * rows, 3, 255.f);
  for (int y = 0; y < rows; ++y) {
    const int b0 = y0 + static_cast<int>(y * step),
              b1 = std::max(b0 + 1, y0 + static_cast<int>((y + 1) * step));
    for (int x = 0; x < columns; ++x) {
      const int a0 = x0 + static_cast<int>(x * step),
                a1 = std::max(a0 + 1, x0 + static_cast<int>((x + 1) * step));
      int inside = 0, all = 0;
      Eigen::Array3f sum = Eigen::Array3f::Zero();
      for (int b = b0; b < b1 && b < height; ++b) {
        for (int a = a0; a < a1 && a < width; ++a) {
          ++all;
          if (!solid[b * width + a]) continue;
          ++inside;
          const Colour c = canvas.colour(a, b);
          sum += Eigen::Array3f(c[0], c[1], c[2]);
        }
      }
      if (2 * inside >= all && inside > 0) {
        grid[y * columns + x] = 1;
        colours.row(y * columns + x) = (sum / static_cast<float>(inside)).transpose();
      }
    }
  }
  if ((canvas.whole ? joinFigure(grid, columns, rows) : keepLargestPart(grid, columns, rows)) < .8)
    return std::nullopt;

  Figure figure;
  figure.whole = canvas.whole && cut != Cut::kHeavy;
  figure.view = canvas.view;
  figure.kind = canvas.kind;
  figure.mask.resize(rows, columns);
  for (int i = 0; i < rows * columns; ++i) figure.mask.data()[i] = grid[i] ? 255 : 0;
  if (rng.chance(.07)) {  // cut out of black or coloured paper
    colours.rowwise() =
        Eigen::Array3f(static_cast<float>(rng.uniform(0, 120)), static_cast<float>(rng.uniform(0, 120)),
                       static_cast<float>(rng.uniform(0, 120)))
            .transpose();
  } else if (rng.chance(.15)) {
    shadeRound(rng, colours, grid, columns, rows);
  }
  if (rng.chance(.3)) {  // light from one side
    const double angle = rng.uniform(0, 2 * std::numbers::pi), depth = rng.uniform(.1, .5);
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        const double t =
            ((x - columns / 2.) * std::cos(angle) + (y - rows / 2.) * std::sin(angle)) / kLongSide;
        colours.row(y * columns + x) *= static_cast<float>(1 + depth * t);
      }
    }
  }
  Rng brush = rng.branch(1);  // shapes do not depend on how they are painted
  repaint(brush, figure.mask, colours);
  if (rng.chance(.35)) {  // grain of paper, noise of a camera
    const auto grain = static_cast<float>(rng.uniform(2, 14));
    for (float& c : colours.reshaped()) c += grain * static_cast<float>(rng.normal());
  }
  figure.look = figureLook(colours, figure.mask);
  figure.visible = std::move(canvas.visible);
  figure.absent = std::move(canvas.absent);
  figure.unknown = std::move(canvas.unknown);
  for (const Vec& p : canvas.joints) figure.joints.push_back((p - Vec(x0, y0)) / step - Vec::Constant(.5));
  if (figure.whole && !isReadable(figure, plan)) return std::nullopt;
  if (figure.view == FigureView::kSide) sortSides(figure, jointsOf(plan));
  return figure;
}

std::optional<Figure> render(Rng& rng, const FigurePlan& plan, const Drawing& drawing, Cut cut) {
  const Scene::Box box = drawing.scene.box();
  const Vec size = box.high - box.low;
  const double scale = kOversampling * kLongSide / size.maxCoeff();
  const int width = static_cast<int>(std::ceil(size.x() * scale)) + 2 * kMargin;
  const int height = static_cast<int>(std::ceil(size.y() * scale)) + 2 * kMargin;
  const Vec low = box.low - Vec::Constant(kMargin / scale);
  const Raster raster = rasterize(drawing.scene, low, scale, width, height);

  Canvas canvas{width,        height,       Bits(raster.part.size()), {}, {}, {}, {}, {}, drawing.view,
                drawing.kind, drawing.whole};
  canvas.absent.assign(plan.joints.size(), false);
  canvas.unknown = canvas.absent;
  for (const int j : drawing.absent) canvas.absent[static_cast<std::size_t>(j)] = true;
  for (std::size_t i = 0; i < canvas.solid.size(); ++i) canvas.solid[i] = raster.part[i] != 0;
  canvas.colour = [&](int x, int y) { return raster.colour(x, y); };
  for (std::size_t j = 0; j < plan.joints.size(); ++j) {
    const Vec p = (drawing.joints[j] - low) * scale;
    const int x = std::clamp(static_cast<int>(p.x()), 0, width - 1),
              y = std::clamp(static_cast<int>(p.y()), 0, height - 1);
    canvas.joints.push_back(p);
    // Inside a limb that is drawn as an outline there is nothing.
    canvas.visible.push_back(!raster.solid(x, y) || bearer(raster.owner(x, y)) == plan.joints[j].owner);
  }
  return finished(rng, plan, std::move(canvas), cut);
}

// What is pasted onto a drawing.
struct Pasted {
  std::vector<const SmallDrawing*> things;
  const SmallDrawing* neighbour = nullptr;
};

// One of the drawings, in other proportions. `turn`: radians, from +x towards +y.
std::optional<Figure> renderDrawn(Rng& rng, const FigurePlan& plan, const SmallDrawing& drawing,
                                  const Pasted& pasted, double turn, Cut cut) {
  constexpr int kSide = kOversampling * kLongSide;
  const int margin = pasted.neighbour         ? kSide
                     : !pasted.things.empty() ? static_cast<int>(kThingMargin * kSide)
                                              : kMargin;
  WarpedDrawing warped = warpedDrawing(rng, drawing, turn, kSide, margin);
  std::vector<bool> visible(plan.joints.size(), true);
  for (const SmallDrawing* thing : pasted.things) pasteThing(rng, plan, *thing, kSide, warped, visible);
  if (pasted.neighbour) pasteNeighbour(rng, *pasted.neighbour, kSide, warped);
  const int width = warped.width, height = warped.height;
  const bool whole = turn == 0 && !pasted.neighbour;
  Canvas canvas{width, height,          warped.solid, {}, warped.joints, std::move(visible),
                {},    drawing.unknown, drawing.view, 0,  whole};
  canvas.absent.assign(plan.joints.size(), false);
  if (canvas.unknown.empty()) canvas.unknown = canvas.absent;
  canvas.colour = [&](int x, int y) { return warped.colours[static_cast<std::size_t>(y) * width + x]; };
  return finished(rng, plan, std::move(canvas), cut);
}

}  // namespace

Figure generateFigure(Rng& rng, const FigureOptions& options) {
  const FigurePlan& plan = figurePlan(options.body_plan);
  while (true) {
    if (options.drawn_share > 0 && rng.chance(options.drawn_share)) {
      const auto any_drawing = [&]() -> const SmallDrawing& {
        return options.drawings[rng.below(static_cast<std::uint32_t>(options.drawings.size()))];
      };
      const SmallDrawing& drawing = any_drawing();
      enum class Kind { kWhole, kCut, kTurned, kPair } kind = Kind::kWhole;
      if (rng.chance(options.other_share)) {
        const double r = rng.uniform();
        kind = r < .4 ? Kind::kCut : r < .75 ? Kind::kTurned : Kind::kPair;
      }
      const double turn = kind == Kind::kTurned ? rng.uniform(1.2, 2 * std::numbers::pi - 1.2) : 0;
      Pasted pasted;
      while (kind == Kind::kWhole && pasted.things.size() < 2 && rng.chance(.25))
        pasted.things.push_back(&any_drawing());
      if (kind == Kind::kPair) pasted.neighbour = &any_drawing();
      if (auto figure =
              renderDrawn(rng, plan, drawing, pasted, turn, kind == Kind::kCut ? Cut::kHeavy : Cut::kNone))
        return *std::move(figure);
      continue;
    }
    Drawing drawing;
    Cut cut = Cut::kNone;
    if (rng.chance(options.other_share)) {
      const double r = rng.uniform();
      if (r < .32) {
        drawing.scene = plan.drawOther(rng);
        drawing.scene.transform(sampleWarp(rng));
        drawing.joints.assign(plan.joints.size(), Vec::Zero());
        drawing.whole = false;
      } else if (r < .52) {
        drawing = drawFigure(rng, plan, options);
        cut = Cut::kHeavy;
      } else if (r < .86) {  // lying or upside down: to be told from upright, so that it can be turned
        drawing = drawFigure(rng, plan, options);
        const double angle = rng.uniform(1.2, 2 * std::numbers::pi - 1.2);
        drawing.scene.transform([&](const Vec& p) { return rotated(p, angle); });
        drawing.whole = false;
      } else {
        drawing = drawPair(rng, plan, options);
      }
    } else {
      drawing = drawFigure(rng, plan, options);
      if (rng.chance(.05)) cut = Cut::kSlight;
      if (rng.chance(.08)) {
        Scene junk = sampleJunk(rng, drawing.scene);
        junk.append(drawing.scene);
        drawing.scene = std::move(junk);
      }
    }
    if (std::optional<Figure> figure = render(rng, plan, drawing, cut)) return *std::move(figure);
  }
}

}  // namespace skel
