#include "libskel/silhouette/segment.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "libskel/silhouette/background.h"
#include "libskel/silhouette/chambers.h"
#include "libskel/silhouette/outlined.h"
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

}  // namespace

Segmentation segment(const Image& image) {
  const cv::Mat rgb = workingRgb(image);
  const cv::Mat lab = labOf(rgb);

  double explained_border = 0;
  const std::vector<Background> backgrounds = fitBackgrounds(lab, explained_border);
  if (explained_border < 0.4)
    return {{}, "no background can be told: the picture's border has no colour in common"};
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
  if (cv::countNonZero(barrier) == 0) return {{}, "the picture is blank"};

  const cv::Mat drawn = barrier.clone();
  fillChambers(barrier);
  if (textured) {
    dropOuterEdges(barrier, edges);
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
  if (cv::countNonZero(barrier) == 0) return {{}, "nothing stands out from the background"};

  cv::Mat full;
  if (barrier.cols == image.width && barrier.rows == image.height) {
    full = barrier;
  } else {
    cv::resize(barrier, full, cv::Size(image.width, image.height), 0, 0, cv::INTER_LINEAR);
    full = full >= 128;
  }
  // The edges of strokes on paper are soft: what is seen as a stroke is its core.
  if (textured) cv::dilate(full, full, cv::Mat::ones(3, 3, CV_8U));
  Segmentation out;
  out.foreground = Eigen::Map<Plane8>(full.data, full.rows, full.cols);
  return out;
}

}  // namespace skel
