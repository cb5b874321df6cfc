#include "libskel/silhouette/mask_evidence.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "libskel/core/check.h"
#include "libskel/silhouette/components.h"
#include "libskel/silhouette/working_colors.h"

namespace skel {
namespace {

Component largestPiece(const cv::Mat& mask) {
  const cv::Rect place = cv::boundingRect(mask);
  if (place.empty()) return {};
  cv::Mat labels;
  const std::vector<Component> pieces = componentsOf(mask(place), 4, labels);
  Component largest = pieces[static_cast<std::size_t>(largestOf(pieces))];
  largest.x += place.x, largest.y += place.y;
  return largest;
}

// Of `mask`, what is thicker than a strip along its edge.
cv::Mat core(const cv::Mat& mask, int reach) {
  cv::Mat out;
  cv::morphologyEx(mask, out, cv::MORPH_OPEN,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * reach + 1, 2 * reach + 1)));
  return out;
}

}  // namespace

MaskEvidence evidenceOfMask(const Plane8& mask, const SeenPage& page) {
  SKEL_CHECK(mask.size() > 0 && page.share.size() > 0);
  const cv::Mat probability = viewOf(page.share);
  cv::Mat figure;
  cv::resize(viewOf(mask), figure, probability.size(), 0, 0, cv::INTER_AREA);
  figure = figure >= 128;
  constexpr int kPerhaps = 77, kSurely = 178;  // of 255
  const int long_side = std::max(figure.cols, figure.rows);
  const int reach = std::max(1, cvRound(long_side / 100.));
  const double area = std::max(1, cv::countNonZero(figure));
  const auto sumOver = [&](const cv::Mat& where) { return cv::mean(probability, where)[0] / 255; };

  cv::Mat undecided;
  probability.convertTo(undecided, CV_32F, 1 / 255.);
  const double seen = std::max(1e-9, cv::sum(undecided)[0]);
  const double both = sumOver(figure) * area;
  undecided = undecided.mul(1 - undecided);
  const cv::Mat not_seen = core(figure & (probability < kPerhaps), reach),
                not_taken = core(~figure & (probability > kSurely), reach);
  cv::Mat around;
  cv::dilate(figure, around,
             cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(8 * reach + 1, 8 * reach + 1)));
  around &= ~figure;
  cv::Mat edge;
  cv::morphologyEx(figure, edge, cv::MORPH_GRADIENT, cv::Mat::ones(3, 3, CV_8U));
  double at_border = 0;
  for (const cv::Mat& side :
       {figure.row(0), figure.row(figure.rows - 1), figure.col(0), figure.col(figure.cols - 1)})
    at_border += cv::countNonZero(side);

  MaskEvidence out;
  const Component doubtful = largestPiece(not_seen), missing = largestPiece(not_taken);
  out.inputs.resize(static_cast<Eigen::Index>(kMaskInputs.size()));
  const auto damped = [](double share) { return std::log10(share + 1e-3); };
  out.inputs << both / std::max(1e-9, area + seen - both), damped(cv::countNonZero(not_seen) / area),
      damped(doubtful.area / area), damped(cv::countNonZero(not_taken) / area), damped(missing.area / area),
      sumOver(figure), sumOver(around), damped(cv::sum(undecided)[0] / area),
      damped(area / static_cast<double>(figure.total())), cv::countNonZero(edge) / std::sqrt(area),
      at_border / (2. * (figure.cols + figure.rows)), page.sheet, page.ruled, page.soft;
  const double x = double(mask.cols()) / figure.cols, y = double(mask.rows()) / figure.rows;
  const auto boxOf = [&](const Component& piece) -> std::optional<Eigen::Array4d> {
    if (piece.area == 0) return std::nullopt;
    return Eigen::Array4d(piece.x * x, piece.y * y, piece.width * x, piece.height * y);
  };
  out.doubtful = boxOf(doubtful);
  out.missing = boxOf(missing);
  return out;
}

}  // namespace skel
