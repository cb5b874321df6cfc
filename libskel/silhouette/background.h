// The colours of the background, from the picture's border.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace cv {
class Mat;
}

namespace skel {

// The background's colour as a quadratic polynomial of the place, per channel, and how far it strays.
struct Background {
  Eigen::Matrix<double, 6, 3> coefficients;
  double sigma = 0;  // robust deviation of the background from the polynomial, colour units

  static Eigen::Matrix<double, 1, 6> basis(double u, double v) {
    return (Eigen::Matrix<double, 1, 6>() << 1, u, v, u * u, u * v, v * v).finished();
  }
};

// One background that most of the border agrees on, and one more for each corner of the picture that it does
// not explain, and for each colour that takes a part of two sides: sky, ground, hills. A figure that is cut
// by the border seldom fills a corner or shows one colour on two sides. `explained_border` is the share of
// the border that has the main colour or that of a corner.
//
// Each is a robust fit (iteratively reweighted least squares with Tukey's biweight: Holland, Welsch 1977),
// which begins with pixels of the border and then takes in everything that agrees with them.
std::vector<Background> fitBackgrounds(const cv::Mat& lab, double& explained_border);

// How far each pixel's colour is from that of the nearest background, 8-bit.
cv::Mat colorDifference(const cv::Mat& lab, const std::vector<Background>& backgrounds);

// The difference from which on a colour is not the background's: from `low` up to `high` the level that
// fewest pixels have, before the first level that many have. Compression smears colours around edges, and
// pale fills begin not far above that.
double emptiestLevel(const cv::Mat& differences, double low, double high);

}  // namespace skel
