#include "libskel/video/low_pass.h"

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <vector>

#include "libskel/core/check.h"

namespace skel {
namespace {

// exp(−f² / 2s²) with the value ½ at the cutoff, for each frequency of a transform of that length.
std::vector<float> gains(int length, double cutoff) {
  std::vector<float> gain(static_cast<std::size_t>(length));
  for (int i = 0; i < length; ++i) {
    const double frequency = 2.0 * std::min(i, length - i) / length;
    gain[static_cast<std::size_t>(i)] =
        static_cast<float>(std::exp(-std::numbers::ln2 * frequency * frequency / (cutoff * cutoff)));
  }
  return gain;
}

}  // namespace

FloatPlane lowPass(const FloatPlane& plane, double cutoff) {
  SKEL_CHECK(cutoff > 0 && cutoff <= 1);
  const int rows = static_cast<int>(plane.rows()), columns = static_cast<int>(plane.cols());
  if (rows == 0 || columns == 0) return plane;
  // Beyond three deviations of the filter in space nothing is left of it.
  const int reach =
      static_cast<int>(std::ceil(3 * std::sqrt(2 * std::numbers::ln2) / (std::numbers::pi * cutoff)));
  const int margin_y = std::min(reach, rows - 1), margin_x = std::min(reach, columns - 1);
  const int height = cv::getOptimalDFTSize(rows + margin_y),
            width = cv::getOptimalDFTSize(columns + margin_x);
  const cv::Mat given(rows, columns, CV_32F, const_cast<float*>(plane.data()));
  cv::Mat padded;
  const int below = height - rows, right = width - columns;
  // The transform goes round: half of the margin continues the end, half the beginning.
  cv::copyMakeBorder(given, padded, 0, below / 2, 0, right / 2, cv::BORDER_REFLECT);
  cv::copyMakeBorder(padded, padded, below - below / 2, 0, right - right / 2, 0, cv::BORDER_REFLECT);
  cv::dft(padded, padded, cv::DFT_ROWS);
  const auto filterRows = [](cv::Mat& spectrum, const std::vector<float>& gain) {
    // Packed: the mean, then real and imaginary parts by turns.
    for (int y = 0; y < spectrum.rows; ++y) {
      float* row = spectrum.ptr<float>(y);
      for (int x = 0; x < spectrum.cols; ++x) row[x] *= gain[static_cast<std::size_t>((x + 1) / 2)];
    }
  };
  // The filter is a product of one across and one down, so that each direction is a transform by itself.
  filterRows(padded, gains(width, cutoff));
  cv::dft(padded, padded, cv::DFT_ROWS | cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
  cv::Mat turned = padded.t();
  cv::dft(turned, turned, cv::DFT_ROWS);
  filterRows(turned, gains(height, cutoff));
  cv::dft(turned, turned, cv::DFT_ROWS | cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
  FloatPlane result(rows, columns);
  const int x0 = right - right / 2, y0 = below - below / 2;
  cv::Mat out(rows, columns, CV_32F, result.data());
  cv::transpose(turned(cv::Rect(y0, x0, rows, columns)), out);
  return result;
}

}  // namespace skel
