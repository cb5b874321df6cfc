#include "libskel/silhouette/segment.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "libskel/silhouette/background.h"
#include "libskel/silhouette/chambers.h"
#include "libskel/silhouette/ground.h"
#include "libskel/silhouette/outlined.h"
#include "libskel/silhouette/page.h"
#include "libskel/silhouette/ruling.h"
#include "libskel/silhouette/sheet.h"
#include "libskel/silhouette/strokes.h"
#include "libskel/silhouette/trim.h"
#include "libskel/silhouette/working_colors.h"

namespace skel {
namespace {

// No sheet of paper in fair light.
bool isColored(const Background& background) {
  const double chroma = std::hypot(background.coefficients(0, 1) - 128, background.coefficients(0, 2) - 128);
  return chroma > 12 || background.coefficients(0, 0) < 160;
}

// Pencil leaves gaps, and so does what was taken off with the ruling. `lines` becomes `drawn` with its gaps
// closed, and wide ones, too, where little is enclosed without and much more with them.
constexpr int kPencilGap = 5;  // px
cv::Mat filledPencil(const cv::Mat& drawn, cv::Mat& lines) {
  cv::Mat filled;
  const int ink = cv::countNonZero(drawn);
  int area = 0;
  for (const int gap : {kPencilGap, 2 * kPencilGap - 1, 3 * kPencilGap}) {
    cv::Mat closed, wider;
    cv::morphologyEx(drawn, closed, cv::MORPH_CLOSE,
                     cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(gap, gap)));
    wider = closed.clone();
    fillChambers(wider);
    const int wider_area = cv::countNonZero(wider);
    constexpr double kMuchMore = 1.3, kFilled = 2.5;
    if (wider_area > kMuchMore * area) {
      lines = closed;
      filled = wider;
      area = wider_area;
    }
    if (area > kFilled * ink) break;
  }
  return filled;
}

// Makes `rgb`, the whole picture, the sheet alone.
cv::Mat straightened(const Image& image, cv::Mat& rgb, PageCorners corners) {
  for (Eigen::Vector2d& corner : corners)
    corner = ((corner.array() + 0.5) * (static_cast<double>(image.width) / rgb.cols) - 0.5).matrix();
  std::array<int, 2> size{};
  const cv::Mat page_from_image = pageFromPicture(corners, size);
  cv::Mat rgba(image.height, image.width, CV_8UC4, const_cast<std::uint8_t*>(image.rgba.data())), page;
  cv::warpPerspective(rgba, page, page_from_image, cv::Size(size[0], size[1]), cv::INTER_LINEAR,
                      cv::BORDER_REPLICATE);
  // cvtColor() would bring along every colour space that OpenCV knows.
  rgb.create(page.size(), CV_8UC3);
  cv::mixChannels(page, rgb, {0, 0, 1, 1, 2, 2});
  return page_from_image;
}

// The mask of the figures in `rgb`, and in `reason` why there is none.
cv::Mat figuresIn(const cv::Mat& rgb, const cv::Mat& lab, std::string& reason, int& margin) {
  double explained_border = 0;
  const std::vector<Background> backgrounds = fitBackgrounds(lab, explained_border);
  if (explained_border < 0.4) {
    reason = "no background can be told: the picture's border has no colour in common";
    return {};
  }
  const cv::Mat difference = colorDifference(lab, backgrounds);
  double sigma = 0;
  for (const Background& b : backgrounds) sigma = std::max(sigma, b.sigma);
  const double low_color = std::max(6.0, 3.5 * sigma);
  const double color_threshold = emptiestLevel(difference, low_color, low_color + 14);
  const cv::Mat far = difference > color_threshold;

  const bool dark_background = backgrounds.front().coefficients(0, 0) < 90;
  cv::Mat contrast = strokeContrast(rgb, dark_background, false);
  Noise noise = noiseOf(contrast, far);
  const bool textured = noise.level + noise.deviation > 2;
  if (textured) {
    contrast = strokeContrast(rgb, dark_background, true);
    noise = noiseOf(contrast, far);
  }
  const double low = std::max(12.0, noise.level + 4 * noise.deviation);
  const double high = std::max(30.0, noise.level + 7 * noise.deviation);
  const cv::Mat strokes = hysteresis(contrast, low, high);
  cv::Mat barrier, edges;
  if (textured) {
    barrier = drawnOnPaper(lab, strokes, far);
    edges = edgesOnPaper(lab) & ~barrier;
    barrier |= edges;
  } else {
    // A gap between bright fills on a dark ground looks like a stroke, but in the background's colour.
    barrier = (strokes & (difference > low_color)) | far;
  }
  if (cv::countNonZero(barrier) == 0) {
    reason = "the picture is blank";
    return {};
  }

  const cv::Mat drawn = barrier.clone();
  cv::Mat lines = barrier;
  if (textured) {
    barrier = filledPencil(drawn, lines);
  } else {
    barrier = lines.clone();
    fillChambers(barrier);
  }
  dropGround(barrier, lines);
  if (textured) {
    dropOuterEdges(barrier, edges);
    for (int i = 0; i < kPencilGap / 2; ++i) dropOuterEdges(barrier, lines & ~drawn);
  } else {
    // Scenery shows at the border of the picture.
    cv::Mat outlined;
    if (backgrounds.size() > 1 || touchesBorder(barrier)) outlined = outlinedFigure(lab, barrier);
    const bool scenery = !outlined.empty();
    if (scenery) barrier = outlined;
    openLoops(barrier, drawn, isColored(backgrounds.front()));
    if (!scenery) trimSoftEdge(barrier, drawn, cv::max(difference, contrast));
  }
  dropBorderStrips(barrier);
  if (cv::countNonZero(barrier) == 0) {
    reason = "nothing stands out from the background";
    return {};
  }
  // The edges of strokes on paper are soft: what is seen as a stroke is its core.
  margin = textured ? 1 : 0;
  return barrier;
}

}  // namespace

Segmentation segment(const Image& image) {
  const cv::Size full_size(image.width, image.height);
  cv::Mat rgb = workingRgb(image), lab = labOf(rgb);
  cv::Mat page_from_image;
  if (const std::optional<PageCorners> corners = findPage(lab)) {
    page_from_image = straightened(image, rgb, *corners);
    lab = labOf(rgb);
  }
  if (eraseRuling(rgb)) lab = labOf(rgb);
  Segmentation out;
  int margin = 0;
  const cv::Mat figures = figuresIn(rgb, lab, out.reason, margin);
  if (!out.reason.empty()) return out;
  cv::Mat full;
  if (!page_from_image.empty()) {
    cv::warpPerspective(figures, full, page_from_image, full_size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
    full = full >= 128;
  } else if (figures.size() == full_size) {
    full = figures;
  } else {
    cv::resize(figures, full, full_size, 0, 0, cv::INTER_LINEAR);
    full = full >= 128;
  }
  if (margin > 0) cv::dilate(full, full, cv::Mat::ones(2 * margin + 1, 2 * margin + 1, CV_8U));
  out.foreground = Eigen::Map<Plane8>(full.data, full.rows, full.cols);
  return out;
}

}  // namespace skel
