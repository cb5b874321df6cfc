#include "libskel/silhouette/silhouette.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "libskel/core/check.h"
#include "libskel/core/sha256.h"
#include "libskel/silhouette/close_slits.h"
#include "libskel/silhouette/fill_holes.h"
#include "libskel/silhouette/line_art.h"
#include "libskel/silhouette/outline.h"
#include "libskel/silhouette/paper.h"
#include "libskel/silhouette/pieces.h"
#include "libskel/silhouette/segment.h"
#include "libskel/silhouette/steps.h"
#include "libskel/silhouette/working_colors.h"
#include "libskel/silhouette/working_grid.h"

namespace skel {
namespace {

Silhouette noFigure(const std::string& reason) {
  Silhouette none;
  none.reason = reason;
  return none;
}

constexpr int kMinLongSide = 8;  // of a figure, px

// A spot on a large sheet is no figure either.
int leastLongSide(const Image& image) {
  return std::max(kMinLongSide, std::max(image.width, image.height) / 16);
}

// Names the sides of the picture along which a good part of the figure ends.
std::string cutSides(const Plane8& mask) {
  const cv::Rect box = cv::boundingRect(viewOf(mask));
  const auto cut = [&](auto side) {
    const Eigen::Index touching = (side > 0).count();
    return touching >= 3 && touching * 20 >= std::max(box.width, box.height);
  };
  std::string sides;
  const auto add = [&](bool is_cut, const char* name) {
    if (is_cut) sides += (sides.empty() ? "" : ", ") + std::string(name);
  };
  add(cut(mask.row(0)), "top");
  add(cut(mask.row(mask.rows() - 1)), "bottom");
  add(cut(mask.col(0)), "left");
  add(cut(mask.col(mask.cols() - 1)), "right");
  return sides;
}

// All figures of a picture.
struct Cut {
  std::vector<JoinedFigure> figures = {};  // the largest first
  Eigen::Index height = 0, width = 0;
  bool close_slits = false;
  bool clear_around = false;
  std::string reason;  // why there are none
  std::optional<SeenPage> seen = std::nullopt;
  std::optional<std::vector<RuledLine>> ruling = std::nullopt;
  Plane8 enclosed = {};  // Segmentation::enclosed
};

Cut cutOut(const Plane8& foreground, int min_long_side, const PieceOptions& pieces = {}) {
  Cut cut{joinPieces(foreground, min_long_side, pieces),
          foreground.rows(),
          foreground.cols(),
          pieces.close_slits,
          false,
          "",
          std::nullopt,
          std::nullopt,
          {}};
  if (cut.figures.empty())
    cut.reason =
        (foreground != 0).any() ? "what is drawn is too small to be a figure" : "the picture is blank";
  return cut;
}

// One clean figure and all that is made of it.
Silhouette finish(const Cut& cut, const SilhouetteOptions& options) {
  SKEL_CHECK(options.figure >= 1);
  if (!cut.reason.empty()) return noFigure(cut.reason);
  Silhouette out;
  out.figure_count = static_cast<int>(cut.figures.size());
  if (options.figure > out.figure_count) {
    out.reason =
        "there is no figure " + std::to_string(options.figure) + ", only " + std::to_string(out.figure_count);
    return out;
  }
  JoinedFigure figure = cut.figures[static_cast<std::size_t>(options.figure - 1)];
  if (cut.close_slits) closeSlits(figure.mask);
  out.status = SilhouetteStatus::kFound;
  out.mask = figure.inPicture(figure.mask, cut.height, cut.width);
  out.bridges = figure.inPicture(figure.bridges, cut.height, cut.width);
  if (options.fill_holes) fillHoles(out.mask);
  if (out.figure_count > 1 && options.figure == 1 && !options.all) {
    out.warnings.push_back("the picture shows " + std::to_string(out.figure_count) +
                           " figures; the largest is taken (choose another with --figure)");
  }
  out.clear_around = cut.clear_around;
  if (!out.clear_around) out.cut_sides = cutSides(out.mask);
  if (!out.cut_sides.empty())
    out.warnings.push_back("the figure is cut by the border of the picture (" + out.cut_sides + ")");
  if (cut.seen) out.evidence = evidenceOfMask(out.mask, *cut.seen);
  if (cut.enclosed.size() > 0) out.enclosed = enclosedGround(out.mask, cut.enclosed);
  out.ruling = cut.ruling;
  out.outline = traceOutline(out.mask);
  out.grid = gridOver(out.mask);
  out.grid_mask = sampleMask(out.mask, out.grid);
  return out;
}

// Transparency tells the figure unless it only rounds the corners of an opaque picture.
struct AlphaMask {
  bool meaningful = false;
  Plane8 opaque;
};

AlphaMask alphaMask(const Image& image, std::optional<double> least = std::nullopt) {
  AlphaMask out;
  int weakest = 255, strongest = 0;
  for (Eigen::Index i = 0; i < image.rgba.rows(); ++i) {
    weakest = std::min<int>(weakest, image.rgba(i, 3));
    strongest = std::max<int>(strongest, image.rgba(i, 3));
  }
  const int threshold =
      std::max(1, least ? int(std::lround(255 * *least)) : std::min(128, (strongest + 1) / 2));
  if (weakest >= threshold) return out;
  out.opaque = Plane8(image.height, image.width);
  std::int64_t area = 0;
  int left = image.width, right = 0, top = image.height, bottom = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const bool opaque = image.pixel(x, y)[3] >= threshold;
      out.opaque(y, x) = opaque ? 255 : 0;
      if (!opaque) continue;
      ++area;
      left = std::min(left, x);
      right = std::max(right, x + 1);
      top = std::min(top, y);
      bottom = y + 1;
    }
  }
  const double box_area = static_cast<double>(right - left) * (bottom - top);
  out.meaningful = area == 0 || static_cast<double>(area) < 0.97 * box_area;
  return out;
}

// Whether more of the figure than its edges can be seen through, and not all of it; holes that are filled are
// none of it.
bool muchIsSoft(const Image& image, const Plane8& mask) {
  constexpr double kSoft = 0.9;   // of the most opaque pixel
  constexpr double kMuch = 0.05;  // of the figure
  constexpr int kEdge = 2;        // px, where it is drawn smoothly
  const double strongest = image.rgba.col(3).maxCoeff();
  Plane8 soft(mask.rows(), mask.cols());
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t alpha = image.pixel(x, y)[3];
      soft(y, x) = mask(y, x) && alpha > 0 && alpha < kSoft * strongest ? 255 : 0;
    }
  cv::Mat inner;
  cv::erode(viewOf(soft), inner, cv::Mat::ones(2 * kEdge + 1, 2 * kEdge + 1, CV_8U));
  return double(cv::countNonZero(inner)) > kMuch * double((mask != 0).count());
}

// What the grain of paper left beside the figure is small and lies near it.
PieceOptions piecesOnPaper() {
  PieceOptions pieces;
  pieces.widest_gap = 0.06;
  pieces.smallest_share = 0.01;
  pieces.limbs_first = true;
  pieces.close_slits = true;
  return pieces;
}

Cut cutOffPaper(const Image& image, const SilhouetteOptions& options) {
  const Segmentation segmentation = segment(image, options.page_net.get());
  if (!segmentation.reason.empty()) return {.reason = segmentation.reason};
  Cut cut = cutOut(segmentation.foreground, leastLongSide(image), piecesOnPaper());
  cut.seen = segmentation.seen;
  cut.ruling = segmentation.ruling;
  cut.enclosed = segmentation.enclosed;
  return cut;
}

void warnOfSheet(Silhouette& out) {
  constexpr double kMuch = 0.45, kCompact = 0.1;  // of the picture; open share
  out.is_sheet =
      out.found() &&
      static_cast<double>((out.mask != 0).count()) > kMuch * static_cast<double>(out.mask.size()) &&
      openShare(out.mask) < kCompact;
  if (out.is_sheet)
    out.warnings.push_back(
        "the sheet itself was probably taken for the figure: crop the photo, or paint a mask (skel-label "
        "FILE)");
}

// Of line art: there is paper around it, too.
Cut cutOfLines(const Image& image, const SilhouetteOptions& options) {
  const int margin = std::max(4, std::max(image.width, image.height) / 16);
  Image wide(image.width + 2 * margin, image.height + 2 * margin);
  wide.rgba.setZero();
  for (int y = 0; y < image.height; ++y)
    std::copy_n(image.pixel(0, y), 4 * image.width, wide.pixel(margin, margin + y));
  const Segmentation segmentation = segment(laidOnPaper(std::move(wide)), options.page_net.get());
  if (!segmentation.reason.empty()) return {.reason = segmentation.reason};
  Cut cut = cutOut(segmentation.foreground.block(margin, margin, image.height, image.width),
                   leastLongSide(image), piecesOnPaper());
  cut.clear_around = true;
  if (const Plane8& enclosed = segmentation.enclosed; enclosed.size() > 0) {
    const double scale = double(enclosed.cols()) / (image.width + 2 * margin);
    const auto scaled = [scale](int px) { return static_cast<Eigen::Index>(std::lround(scale * px)); };
    cut.enclosed = enclosed.block(scaled(margin), scaled(margin), scaled(image.height), scaled(image.width));
  }
  return cut;
}

Cut cutByAlpha(const Image& image, const AlphaMask& alpha, const SilhouetteOptions& options) {
  if ((alpha.opaque != 0).any()) {
    Cut cut = cutOut(alpha.opaque, kMinLongSide);
    cut.clear_around = true;
    return cut;
  }
  return {.reason = image.rgba.col(3).maxCoeff() > 0 && options.alpha
                        ? "nothing in the picture is as opaque as --alpha asks for"
                        : "the picture is fully transparent"};
}

}  // namespace

struct FigureFinder::Found {
  bool by_alpha = false;
  std::optional<Cut> lines, all;  // all: whatever is drawn, looked for where the lines are no line art
};

FigureFinder::FigureFinder(SilhouetteOptions options) : options_(std::move(options)) {}
FigureFinder::~FigureFinder() = default;

Silhouette FigureFinder::take(const Image& image, int figure) {
  options_.figure = figure;
  if (image.empty()) return noFigure("the picture is empty");
  if (!found_) found_ = std::make_unique<Found>();
  if (options_.method == SilhouetteMethod::kPaper) {
    options_.fill_holes = true;
    if (!found_->all) {
      found_->all = cutOut(paperForeground(image), leastLongSide(image));
      found_->all->clear_around = alphaMask(image).meaningful;
    }
    return finish(*found_->all, options_);
  }
  if (!found_->lines && !found_->all) {
    const AlphaMask alpha = alphaMask(image, options_.alpha);
    found_->by_alpha = alpha.meaningful;
    if (alpha.meaningful && mayBeLineArt(alpha.opaque)) found_->lines = cutOfLines(image, options_);
  }
  if (found_->lines) {
    Silhouette drawn = finish(*found_->lines, options_);
    if (drawn.found() && needsPaper(image, drawn.mask)) return drawn;
  }
  if (!found_->all)
    found_->all = found_->by_alpha ? cutByAlpha(image, alphaMask(image, options_.alpha), options_)
                                   : cutOffPaper(image, options_);
  Silhouette out = finish(*found_->all, options_);
  if (!found_->by_alpha)
    warnOfSheet(out);
  else if (out.found() && muchIsSoft(image, out.mask))
    out.warnings.push_back(
        "much of the figure is half-transparent: if that is a glow or a shadow, leave it out by --alpha "
        "0.9");
  return out;
}

Silhouette extractSilhouette(const Image& image, const SilhouetteOptions& options) {
  return FigureFinder(options).take(image, options.figure);
}

SilhouetteSteps silhouetteSteps(const Image& image) {
  if (image.empty() || alphaMask(image).meaningful) return {};
  return segment(image, nullptr, true).steps;
}

namespace {

Silhouette silhouetteOfMask(const Plane8& mask, bool clear_around, const SilhouetteOptions& options) {
  if (mask.size() == 0) return noFigure("the mask is empty");
  const Eigen::Index w = mask.cols(), h = mask.rows();
  Plane8 figures = (mask >= 128).select(Plane8::Constant(h, w, 255), Plane8::Zero(h, w));
  PieceOptions pieces;
  pieces.leave_ground = false;
  pieces.widest_gap = 0.16;
  Cut cut = cutOut(figures, kMinLongSide, pieces);
  cut.clear_around = clear_around;
  Silhouette out = finish(cut, options);
  if (!out.found() && out.reason == "the picture is blank") out.reason = "the mask is blank";
  return out;
}

}  // namespace

Silhouette silhouetteFromMask(const Plane8& mask, const SilhouetteOptions& options) {
  return silhouetteOfMask(mask, false, options);
}

Silhouette silhouetteFromMask(const Plane8& mask, const Image& image, const SilhouetteOptions& options) {
  return silhouetteOfMask(mask, !image.empty() && alphaMask(image).meaningful, options);
}

std::string outlineHash(const Silhouette& silhouette) {
  SKEL_CHECK(silhouette.found());
  std::string text;  // corners lie between pixels: whole numbers after half a pixel's step
  for (const Polygon& polygon : silhouette.outline) {
    for (const Eigen::Vector2d& corner : polygon)
      text += std::to_string(std::lround(corner.x() + 0.5)) + "," +
              std::to_string(std::lround(corner.y() + 0.5)) + " ";
    text += "\n";
  }
  return sha256(text);
}

}  // namespace skel
