#include "libskel/silhouette/segment.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "libskel/silhouette/chambers.h"

namespace skel {
namespace {

// Long side of the picture on which figures are found, px. Larger ones are reduced.
constexpr int kWorkSize = 512;

// RGB on white at the working size.
cv::Mat reduced(const Image& image) {
  cv::Mat rgba(image.height, image.width, CV_8UC4, const_cast<std::uint8_t*>(image.rgba.data()));
  const double scale = std::min(1.0, kWorkSize / static_cast<double>(std::max(image.width, image.height)));
  cv::Mat small;
  if (scale < 1) {
    const cv::Size size(std::max(1, cvRound(image.width * scale)),
                        std::max(1, cvRound(image.height * scale)));
    cv::resize(rgba, small, size, 0, 0, cv::INTER_AREA);
  } else {
    small = rgba;
  }
  cv::Mat rgb(small.size(), CV_8UC3);
  for (int y = 0; y < small.rows; ++y) {
    const cv::Vec4b* from = small.ptr<cv::Vec4b>(y);
    cv::Vec3b* to = rgb.ptr<cv::Vec3b>(y);
    for (int x = 0; x < small.cols; ++x) {
      for (int c = 0; c < 3; ++c) {
        to[x][c] = static_cast<std::uint8_t>(255 - (255 - from[x][c]) * from[x][3] / 255);
      }
    }
  }
  return rgb;
}

double median(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The background's colour as a quadratic polynomial of the place, per channel, and how far it strays.
struct Background {
  Eigen::Matrix<double, 6, 3> coefficients;
  double sigma = 0;  // robust deviation of the background from the polynomial, colour units

  static Eigen::Matrix<double, 1, 6> basis(double u, double v) {
    return (Eigen::Matrix<double, 1, 6>() << 1, u, v, u * u, u * v, v * v).finished();
  }
};

// A robust fit (iteratively reweighted, Tukey's biweight) that begins with the border of the picture and then
// takes in everything that agrees with it.
Background fitBackground(const cv::Mat& lab) {
  const int w = lab.cols, h = lab.rows;
  const int band = std::max(1, std::min(w, h) / 40), step = std::max(1, std::max(w, h) / 128);
  struct Sample {
    Eigen::Matrix<double, 1, 6> basis;
    Eigen::Vector3d color;
    bool border;
    double weight;
  };
  std::vector<Sample> samples;
  for (int y = 0; y < h; y += step) {
    for (int x = 0; x < w; x += step) {
      const bool border = x < band || y < band || x >= w - band || y >= h - band;
      const cv::Vec3b p = lab.at<cv::Vec3b>(y, x);
      samples.push_back({Background::basis(2.0 * x / w - 1, 2.0 * y / h - 1),
                         Eigen::Vector3d(p[0], p[1], p[2]), border, 0});
    }
  }
  Background out;
  out.coefficients.setZero();
  for (int c = 0; c < 3; ++c) {
    std::vector<float> values;
    for (const Sample& s : samples) {
      if (s.border) values.push_back(static_cast<float>(s.color(c)));
    }
    out.coefficients(0, c) = median(values);
  }
  double scale = 40;
  for (int pass = 0; pass < 12; ++pass) {
    const bool everywhere = pass >= 6;
    Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Identity() * 1e-6;
    Eigen::Matrix<double, 6, 3> right = Eigen::Matrix<double, 6, 3>::Zero();
    std::vector<float> distances;
    for (Sample& s : samples) {
      if (!everywhere && !s.border) continue;
      const double distance = (s.color.transpose() - s.basis * out.coefficients).norm();
      const double t = distance / scale;
      s.weight = t < 1 ? (1 - t * t) * (1 - t * t) : 0;
      if (s.weight > 0) distances.push_back(static_cast<float>(distance));
      normal += s.weight * s.basis.transpose() * s.basis;
      right += s.weight * s.basis.transpose() * s.color.transpose();
    }
    if (distances.empty()) break;
    out.coefficients = normal.ldlt().solve(right);
    out.sigma = median(distances);
    scale = std::clamp(5 * out.sigma, 8.0, 40.0);
  }
  return out;
}

// Distance of each pixel's colour from the background, 8-bit.
cv::Mat colorDistance(const cv::Mat& lab, const Background& background) {
  cv::Mat distance(lab.size(), CV_8U);
  const Eigen::Matrix<float, 6, 3> c = background.coefficients.cast<float>();
  for (int y = 0; y < lab.rows; ++y) {
    const float v = 2.0f * static_cast<float>(y) / static_cast<float>(lab.rows) - 1;
    const Eigen::RowVector3f constant = c.row(0) + v * c.row(2) + v * v * c.row(5);
    const Eigen::RowVector3f linear = c.row(1) + v * c.row(4), square = c.row(3);
    const cv::Vec3b* row = lab.ptr<cv::Vec3b>(y);
    std::uint8_t* out = distance.ptr(y);
    for (int x = 0; x < lab.cols; ++x) {
      const float u = 2.0f * static_cast<float>(x) / static_cast<float>(lab.cols) - 1;
      float sum = 0;
      for (int k = 0; k < 3; ++k) {
        const float d = static_cast<float>(row[x][k]) - (constant(k) + u * (linear(k) + u * square(k)));
        sum += d * d;
      }
      out[x] = static_cast<std::uint8_t>(std::min(255.0f, std::sqrt(sum) + 0.5f));
    }
  }
  return distance;
}

// Thin dark strokes: how much darker a pixel is, in its darkest channel, than the brightest level that closes
// over it. Blind to steps, such as the edge of a shadow.
cv::Mat strokeContrast(const cv::Mat& rgb, bool dark_background) {
  cv::Mat value(rgb.size(), CV_8U);
  for (int y = 0; y < rgb.rows; ++y) {
    const cv::Vec3b* row = rgb.ptr<cv::Vec3b>(y);
    std::uint8_t* out = value.ptr(y);
    for (int x = 0; x < rgb.cols; ++x) {
      out[x] = dark_background ? std::max({row[x][0], row[x][1], row[x][2]})
                               : std::min({row[x][0], row[x][1], row[x][2]});
    }
  }
  const int size = std::max(3, std::max(rgb.cols, rgb.rows) / 24 * 2 + 1);
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_RECT, cv::Size(size, size));
  cv::Mat contrast;
  cv::morphologyEx(value, contrast, dark_background ? cv::MORPH_TOPHAT : cv::MORPH_BLACKHAT, kernel);
  return contrast;
}

// Pixels above `low` that are connected to some above `high`.
cv::Mat hysteresis(const cv::Mat& values, double low, double high) {
  cv::Mat weak = values > low, labels, stats, centroids;
  const int count = cv::connectedComponentsWithStats(weak, labels, stats, centroids, 8, CV_32S);
  std::vector<std::uint8_t> strong(static_cast<std::size_t>(count), 0);
  for (int y = 0; y < values.rows; ++y) {
    const int* label = labels.ptr<int>(y);
    const std::uint8_t* value = values.ptr(y);
    for (int x = 0; x < values.cols; ++x) {
      if (label[x] > 0 && value[x] > high) strong[static_cast<std::size_t>(label[x])] = 255;
    }
  }
  for (int y = 0; y < values.rows; ++y) {
    const int* label = labels.ptr<int>(y);
    std::uint8_t* out = weak.ptr(y);
    for (int x = 0; x < values.cols; ++x) out[x] = strong[static_cast<std::size_t>(label[x])];
  }
  return weak;
}

}  // namespace

Segmentation segment(const Image& image) {
  const cv::Mat rgb = reduced(image);
  cv::Mat lab;
  cv::cvtColor(rgb, lab, cv::COLOR_RGB2Lab);

  const Background background = fitBackground(lab);
  const double color_threshold = std::max(6.0, 4.5 * background.sigma);
  const cv::Mat distance = colorDistance(lab, background);

  const bool dark_background = background.coefficients(0, 0) < 90;
  const cv::Mat contrast = strokeContrast(rgb, dark_background);
  std::vector<float> levels(contrast.begin<std::uint8_t>(), contrast.end<std::uint8_t>());
  const double level = median(levels);
  for (float& v : levels) v = static_cast<float>(std::abs(v - level));
  const double noise = 1.48 * median(levels);
  const double low = std::max(12.0, level + 4 * noise), high = std::max(30.0, level + 7 * noise);

  cv::Mat barrier = hysteresis(contrast, low, high) | (distance > color_threshold);
  if (cv::countNonZero(barrier) == 0) return {{}, "the picture is blank"};

  fillChambers(barrier);

  cv::Mat full;
  if (barrier.cols == image.width && barrier.rows == image.height) {
    full = barrier;
  } else {
    cv::resize(barrier, full, cv::Size(image.width, image.height), 0, 0, cv::INTER_LINEAR);
    full = full >= 128;
  }
  Segmentation out;
  out.foreground = Eigen::Map<Plane8>(full.data, full.rows, full.cols);
  return out;
}

}  // namespace skel
