#include "libskel/silhouette/background.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>

#include "libskel/silhouette/levels.h"

namespace skel {
namespace {

struct Sample {
  Eigen::Matrix<double, 1, 6> basis;
  Eigen::Vector3d color;
  bool border;
  std::array<bool, 4> on_side;  // left, right, top, bottom
};

constexpr std::size_t kMaxBackgrounds = 6;

std::vector<Sample> samplesOf(const cv::Mat& lab) {
  const int w = lab.cols, h = lab.rows;
  const int band = std::max(1, std::min(w, h) / 40), step = std::max(1, std::max(w, h) / 80);
  std::vector<Sample> samples;
  for (int y = 0; y < h; y += step) {
    for (int x = 0; x < w; x += step) {
      const std::array<bool, 4> on_side = {x < band, x >= w - band, y < band, y >= h - band};
      const bool border = on_side[0] || on_side[1] || on_side[2] || on_side[3];
      const cv::Vec3b p = lab.at<cv::Vec3b>(y, x);
      samples.push_back({Background::basis(2.0 * x / w - 1, 2.0 * y / h - 1),
                         Eigen::Vector3d(p[0], p[1], p[2]), border, on_side});
    }
  }
  return samples;
}

// A robust fit (iteratively reweighted, Tukey's biweight) that begins with those pixels at the border of the
// picture that look like `start`, and then takes in everything that agrees with them.
Background fitBackground(const std::vector<Sample>& samples, const Eigen::Vector3d& start) {
  constexpr int kBorderPasses = 6, kPasses = 12;
  constexpr double kSettled = 0.05;  // change of a coefficient, colour units
  Background out;
  out.coefficients.setZero();
  out.coefficients.row(0) = start.transpose();
  double scale = 40;
  for (int pass = 0; pass < kPasses; ++pass) {
    Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Identity() * 1e-3;
    Eigen::Matrix<double, 6, 3> right = 1e-3 * out.coefficients;
    std::vector<float> distances;
    for (const Sample& s : samples) {
      if (pass < kBorderPasses && !s.border) continue;
      const double distance = (s.color.transpose() - s.basis * out.coefficients).norm();
      if (distance >= scale) continue;
      const double t = distance / scale, weight = (1 - t * t) * (1 - t * t);
      distances.push_back(static_cast<float>(distance));
      normal += weight * s.basis.transpose() * s.basis;
      right += weight * s.basis.transpose() * s.color.transpose();
    }
    if (distances.empty()) break;
    const Eigen::Matrix<double, 6, 3> coefficients = normal.ldlt().solve(right);
    const double change = (coefficients - out.coefficients).cwiseAbs().maxCoeff();
    out.coefficients = coefficients;
    out.sigma = median(distances);
    scale = std::clamp(5 * out.sigma, 8.0, 40.0);
    if (change > kSettled) continue;
    if (pass >= kBorderPasses) break;
    pass = kBorderPasses - 1;
  }
  return out;
}

// A colour that no background explains and that takes a good part of two sides of the picture: hills, a rug,
// a wall. A figure that is cut by the border seldom shows the same colour on two sides.
std::optional<Eigen::Vector3d> colorOnTwoSides(const std::vector<Sample>& samples,
                                               const std::vector<Background>& backgrounds) {
  std::array<int, 4> side_length{};
  std::vector<const Sample*> unexplained;
  for (const Sample& s : samples) {
    if (!s.border) continue;
    for (std::size_t i = 0; i < 4; ++i) side_length[i] += s.on_side[i];
    const bool explained = std::any_of(backgrounds.begin(), backgrounds.end(), [&](const Background& b) {
      return (s.color.transpose() - s.basis * b.coefficients).norm() < std::max(12.0, 4 * b.sigma);
    });
    if (!explained) unexplained.push_back(&s);
  }
  constexpr double kAlike = 10, kMinShare = 0.05;
  std::optional<Eigen::Vector3d> best;
  int most = 0;
  for (const Sample* center : unexplained) {
    std::array<int, 4> on_side{};
    int alike = 0;
    for (const Sample* s : unexplained) {
      if ((s->color - center->color).squaredNorm() > kAlike * kAlike) continue;
      ++alike;
      for (std::size_t i = 0; i < 4; ++i) on_side[i] += s->on_side[i];
    }
    int sides = 0;
    for (std::size_t i = 0; i < 4; ++i) sides += on_side[i] >= std::max(3.0, kMinShare * side_length[i]);
    if (sides >= 2 && alike > most) {
      most = alike;
      best = center->color;
    }
  }
  return best;
}

}  // namespace

std::vector<Background> fitBackgrounds(const cv::Mat& lab, double& explained_border) {
  const std::vector<Sample> samples = samplesOf(lab);
  Eigen::Vector3d start;
  for (int c = 0; c < 3; ++c) {
    std::vector<float> values;
    for (const Sample& s : samples) {
      if (s.border) values.push_back(static_cast<float>(s.color(c)));
    }
    start(c) = median(values);
  }
  std::vector<Background> backgrounds = {fitBackground(samples, start)};
  const int side = std::max(1, std::min(lab.cols, lab.rows) / 32);
  for (const double v : {-1.0, 1.0}) {
    for (const double u : {-1.0, 1.0}) {
      const cv::Rect corner(u < 0 ? 0 : lab.cols - side, v < 0 ? 0 : lab.rows - side, side, side);
      const cv::Scalar mean = cv::mean(lab(corner));
      const Eigen::Vector3d color(mean[0], mean[1], mean[2]);
      bool explained = false;
      for (const Background& b : backgrounds) {
        const double distance = (color.transpose() - Background::basis(u, v) * b.coefficients).norm();
        explained |= distance < std::max(25.0, 4 * b.sigma);
      }
      if (!explained) backgrounds.push_back(fitBackground(samples, color));
    }
  }
  int border = 0, near_any = 0;
  for (const Sample& s : samples) {
    if (!s.border) continue;
    ++border;
    near_any += std::any_of(backgrounds.begin(), backgrounds.end(), [&](const Background& b) {
      return (s.color.transpose() - s.basis * b.coefficients).norm() < 25;
    });
  }
  explained_border = static_cast<double>(near_any) / border;
  while (backgrounds.size() < kMaxBackgrounds) {
    const std::optional<Eigen::Vector3d> color = colorOnTwoSides(samples, backgrounds);
    if (!color) break;
    backgrounds.push_back(fitBackground(samples, *color));
  }
  return backgrounds;
}

cv::Mat colorDifference(const cv::Mat& lab, const std::vector<Background>& backgrounds) {
  cv::Mat difference(lab.size(), CV_8U, cv::Scalar(255));
  for (const Background& background : backgrounds) {
    const Eigen::Matrix<float, 6, 3> c = background.coefficients.cast<float>();
    for (int y = 0; y < lab.rows; ++y) {
      const float v = 2.0f * static_cast<float>(y) / static_cast<float>(lab.rows) - 1;
      const Eigen::RowVector3f constant = c.row(0) + v * c.row(2) + v * v * c.row(5);
      const Eigen::RowVector3f linear = c.row(1) + v * c.row(4), square = c.row(3);
      const cv::Vec3b* row = lab.ptr<cv::Vec3b>(y);
      std::uint8_t* out = difference.ptr(y);
      const float step = 2.0f / static_cast<float>(lab.cols);
      for (int x = 0; x < lab.cols; ++x) {
        const float u = step * static_cast<float>(x) - 1;
        float sum = 0;
        for (int k = 0; k < 3; ++k) {
          const float d = static_cast<float>(row[x][k]) - (constant(k) + u * (linear(k) + u * square(k)));
          sum += d * d;
        }
        out[x] = std::min(out[x], toByte(std::sqrt(sum)));
      }
    }
  }
  return difference;
}

double emptiestLevel(const cv::Mat& differences, double low, double high) {
  std::array<double, 256> count{};
  for (int y = 0; y < differences.rows; ++y) {
    const std::uint8_t* row = differences.ptr(y);
    for (int x = 0; x < differences.cols; ++x) ++count[row[x]];
  }
  double best = low, fewest = 1e300;
  for (int level = static_cast<int>(std::ceil(low)); level <= high && level + 1 < 256; ++level) {
    const double pixels = count[level - 1] + count[level] + count[level + 1];
    if (pixels > 2 * fewest + 0.003 * static_cast<double>(differences.total())) break;
    if (pixels < 0.9 * fewest) {
      fewest = pixels;
      best = level;
    }
  }
  return best;
}

}  // namespace skel
