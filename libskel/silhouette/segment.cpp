#include "libskel/silhouette/segment.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "libskel/silhouette/chambers.h"
#include "libskel/silhouette/simple_point.h"

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
    // Averaging over areas is many times slower and differs little at such a scale.
    cv::resize(rgba, small, size, 0, 0, scale > 0.5 ? cv::INTER_LINEAR : cv::INTER_AREA);
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

std::uint8_t toByte(float v) { return static_cast<std::uint8_t>(std::clamp(v + 0.5f, 0.0f, 255.0f)); }

// CIE Lab (D65) of sRGB, 8-bit: L·2.55, a + 128, b + 128. OpenCV's own conversion first fills tables for 200
// ms.
cv::Mat labOf(const cv::Mat& rgb) {
  constexpr int kSteps = 4096;
  struct Tables {
    std::array<float, 256> linear;
    std::array<float, kSteps + 1> root;  // Lab's f(t), which is steep near 0
    Tables() {
      for (int i = 0; i < 256; ++i) {
        const double v = i / 255.0;
        linear[static_cast<std::size_t>(i)] =
            static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
      }
      for (int i = 0; i <= kSteps; ++i) {
        const double t = static_cast<double>(i) / kSteps;
        root[static_cast<std::size_t>(i)] =
            static_cast<float>(t > 216.0 / 24389 ? std::cbrt(t) : t * 841 / 108 + 4.0 / 29);
      }
    }
  };
  static const Tables tables;
  const auto f = [](float t) {
    return tables.root[static_cast<std::size_t>(std::min(t, 1.0f) * kSteps + 0.5f)];
  };
  cv::Mat lab(rgb.size(), CV_8UC3);
  for (int y = 0; y < rgb.rows; ++y) {
    const cv::Vec3b* from = rgb.ptr<cv::Vec3b>(y);
    cv::Vec3b* to = lab.ptr<cv::Vec3b>(y);
    for (int x = 0; x < rgb.cols; ++x) {
      const float r = tables.linear[from[x][0]], g = tables.linear[from[x][1]], b = tables.linear[from[x][2]];
      const float fx = f(0.433953f * r + 0.376219f * g + 0.189828f * b);
      const float fy = f(0.212671f * r + 0.715160f * g + 0.072169f * b);
      const float fz = f(0.017758f * r + 0.109477f * g + 0.872765f * b);
      to[x] = {toByte(2.55f * (116 * fy - 16)), toByte(500 * (fx - fy) + 128), toByte(200 * (fy - fz) + 128)};
    }
  }
  return lab;
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

struct Sample {
  Eigen::Matrix<double, 1, 6> basis;
  Eigen::Vector3d color;
  bool border;
};

std::vector<Sample> samplesOf(const cv::Mat& lab) {
  const int w = lab.cols, h = lab.rows;
  const int band = std::max(1, std::min(w, h) / 40), step = std::max(1, std::max(w, h) / 80);
  std::vector<Sample> samples;
  for (int y = 0; y < h; y += step) {
    for (int x = 0; x < w; x += step) {
      const bool border = x < band || y < band || x >= w - band || y >= h - band;
      const cv::Vec3b p = lab.at<cv::Vec3b>(y, x);
      samples.push_back(
          {Background::basis(2.0 * x / w - 1, 2.0 * y / h - 1), Eigen::Vector3d(p[0], p[1], p[2]), border});
    }
  }
  return samples;
}

// A robust fit (iteratively reweighted, Tukey's biweight) that begins with those pixels at the border of the
// picture that look like `start`, and then takes in everything that agrees with them.
Background fitBackground(const std::vector<Sample>& samples, const Eigen::Vector3d& start) {
  constexpr int kBorderPasses = 6, kPasses = 12;
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
    out.coefficients = normal.ldlt().solve(right);
    out.sigma = median(distances);
    scale = std::clamp(5 * out.sigma, 8.0, 40.0);
  }
  return out;
}

// One background that most of the border agrees on, and one more for each corner of the picture that it does
// not explain: ground and sky. A figure that is cut by the border seldom fills a corner. `explained_border`
// is the share of the border that has one of these colours.
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
  return backgrounds;
}

// How far each pixel's colour is from that of the nearest background, 8-bit.
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

// The background's colour where `covered` is 0, spread smoothly over the rest: follows any light that changes
// over a few percent of the picture.
cv::Mat expectedColors(const cv::Mat& lab, const cv::Mat& covered) {
  constexpr int kCell = 8;
  const cv::Size coarse((lab.cols + kCell - 1) / kCell, (lab.rows + kCell - 1) / kCell);
  cv::Mat weight(lab.size(), CV_32F), weighted(lab.size(), CV_32FC3);
  for (int y = 0; y < lab.rows; ++y) {
    const std::uint8_t* is_covered = covered.ptr(y);
    const cv::Vec3b* from = lab.ptr<cv::Vec3b>(y);
    float* w = weight.ptr<float>(y);
    cv::Vec3f* to = weighted.ptr<cv::Vec3f>(y);
    for (int x = 0; x < lab.cols; ++x) {
      w[x] = is_covered[x] ? 0.0f : 1.0f;
      to[x] = cv::Vec3f(from[x]) * w[x];
    }
  }
  cv::resize(weight, weight, coarse, 0, 0, cv::INTER_AREA);
  cv::resize(weighted, weighted, coarse, 0, 0, cv::INTER_AREA);
  // Where nothing near is background, what is farther away counts.
  cv::Mat sum = cv::Mat::zeros(coarse, CV_32FC3), total = cv::Mat::zeros(coarse, CV_32F);
  float trust = 1;
  for (const double sigma : {1.5, 6.0, 24.0}) {
    cv::Mat near_weight, near_sum;
    cv::GaussianBlur(weight, near_weight, cv::Size(), sigma, sigma, cv::BORDER_REPLICATE);
    cv::GaussianBlur(weighted, near_sum, cv::Size(), sigma, sigma, cv::BORDER_REPLICATE);
    sum += near_sum * trust;
    total += near_weight * trust;
    trust *= 0.01f;
  }
  for (int y = 0; y < coarse.height; ++y) {
    for (int x = 0; x < coarse.width; ++x) sum.at<cv::Vec3f>(y, x) /= std::max(1e-12f, total.at<float>(y, x));
  }
  cv::Mat expected;
  cv::resize(sum, expected, lab.size(), 0, 0, cv::INTER_LINEAR);
  return expected;
}

// How far each pixel's colour is from the background's, 8-bit: as a whole, in chroma alone, and how much
// darker it is, in 255ths of the background's lightness.
struct Differences {
  cv::Mat color, chroma, darkness;
};

Differences differencesFrom(const cv::Mat& lab, const cv::Mat& expected) {
  Differences out{cv::Mat(lab.size(), CV_8U), cv::Mat(lab.size(), CV_8U), cv::Mat(lab.size(), CV_8U)};
  for (int y = 0; y < lab.rows; ++y) {
    const cv::Vec3b* row = lab.ptr<cv::Vec3b>(y);
    const cv::Vec3f* base = expected.ptr<cv::Vec3f>(y);
    std::uint8_t *color = out.color.ptr(y), *chroma = out.chroma.ptr(y), *darkness = out.darkness.ptr(y);
    for (int x = 0; x < lab.cols; ++x) {
      const cv::Vec3f d = cv::Vec3f(row[x]) - base[x];
      const float squared = d[1] * d[1] + d[2] * d[2];
      color[x] = toByte(std::sqrt(d[0] * d[0] + squared));
      chroma[x] = toByte(std::sqrt(squared));
      darkness[x] = toByte(-255 * d[0] / std::max(1.0f, base[x][0]));
    }
  }
  return out;
}

// The difference from which on a colour is not the background's: from `low` up to `high` the level that
// fewest pixels have, before the first level that many have. Compression smears colours around edges, and
// pale fills begin not far above that.
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

// Thin dark strokes: how much darker a pixel is, in its darkest channel, than the brightest level that closes
// over it. Blind to steps, such as the edge of a shadow.
cv::Mat strokeContrast(const cv::Mat& rgb, bool dark_background, bool smooth) {
  cv::Mat value(rgb.size(), CV_8U);
  for (int y = 0; y < rgb.rows; ++y) {
    const cv::Vec3b* row = rgb.ptr<cv::Vec3b>(y);
    std::uint8_t* out = value.ptr(y);
    for (int x = 0; x < rgb.cols; ++x) {
      out[x] = dark_background ? std::max({row[x][0], row[x][1], row[x][2]})
                               : std::min({row[x][0], row[x][1], row[x][2]});
    }
  }
  if (smooth) cv::GaussianBlur(value, value, cv::Size(3, 3), 0);
  const int size = std::max(3, std::max(rgb.cols, rgb.rows) / 24 * 2 + 1);
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_RECT, cv::Size(size, size));
  cv::Mat contrast;
  cv::morphologyEx(value, contrast, dark_background ? cv::MORPH_TOPHAT : cv::MORPH_BLACKHAT, kernel);
  return contrast;
}

struct Noise {
  double level = 0, deviation = 0;
};

// Of the stroke contrast where the colour is the background's.
Noise noiseOf(const cv::Mat& contrast, const cv::Mat& far) {
  std::vector<float> values;
  for (int y = 0; y < contrast.rows; y += 2) {
    const std::uint8_t *value = contrast.ptr(y), *is_far = far.ptr(y);
    for (int x = 0; x < contrast.cols; x += 2) {
      if (!is_far[x]) values.push_back(value[x]);
    }
  }
  if (values.empty()) return {};
  Noise noise;
  noise.level = median(values);
  for (float& v : values) v = static_cast<float>(std::abs(v - noise.level));
  noise.deviation = 1.48 * median(values);
  return noise;
}

// Pixels above `low` that are connected to some above `high`.
cv::Mat hysteresis(const cv::Mat& values, double low, double high) {
  cv::Mat weak = values > low, labels;
  const int count = cv::connectedComponents(weak, labels, 8, CV_32S);
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

// Strokes, and fills that are surely none of the shadows on a sheet of paper: those change the lightness
// alone and leave more than half of it.
cv::Mat drawnOnPaper(const cv::Mat& lab, const cv::Mat& strokes, const cv::Mat& far) {
  cv::Mat covered;
  cv::dilate(strokes | far, covered, cv::Mat::ones(3, 3, CV_8U));
  const Differences differences = differencesFrom(lab, expectedColors(lab, covered));
  const Noise color = noiseOf(differences.color, covered), chroma = noiseOf(differences.chroma, covered);
  return (strokes & (differences.color > std::max(6.0, color.level + 3 * color.deviation))) |
         (differences.chroma > std::max(8.0, chroma.level + 5 * chroma.deviation)) |
         (differences.darkness > 128);
}

// Edges of fills, one pixel wide. Those of shadows and creases are among them, but enclose nothing.
cv::Mat edgesOnPaper(const cv::Mat& lab) {
  cv::Mat smooth, dx, dy;
  cv::GaussianBlur(lab, smooth, cv::Size(5, 5), 1.2);
  cv::Sobel(smooth, dx, CV_16S, 1, 0);
  cv::Sobel(smooth, dy, CV_16S, 0, 1);
  std::vector<float> steepness;
  for (int y = 0; y < lab.rows; y += 2) {
    const cv::Vec3s *x_row = dx.ptr<cv::Vec3s>(y), *y_row = dy.ptr<cv::Vec3s>(y);
    for (int x = 0; x < lab.cols; x += 2) {
      steepness.push_back(static_cast<float>(std::abs(x_row[x][0]) + std::abs(y_row[x][0])));
    }
  }
  const double noise = median(steepness);
  cv::Mat edges;
  cv::Canny(dx, dy, edges, std::max(14.0, 2.5 * noise), std::max(30.0, 5 * noise));
  return edges;
}

// Takes off pixels of `edges` beside the outside: an edge lies half outside of its fill, and one that
// encloses nothing belongs to none.
void dropOuterEdges(cv::Mat& figure, const cv::Mat& edges) {
  cv::Mat outside;
  cv::dilate(figure == 0, outside, cv::Mat::ones(3, 3, CV_8U));
  figure &= ~(edges & outside);
}

// Takes off the outer pixels that are less than half as strong as their strongest neighbour: where a
// drawing's edge is soft, it lies at half its contrast. Never tears the figure.
void trimSoftEdge(cv::Mat& figure, const cv::Mat& drawn, const cv::Mat& strength) {
  cv::Mat strongest;
  cv::dilate(strength, strongest, cv::Mat::ones(3, 3, CV_8U));
  cv::Mat framed;
  cv::copyMakeBorder(figure, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  for (int y = 0; y < figure.rows; ++y) {
    const std::uint8_t *own = strength.ptr(y), *best = strongest.ptr(y), *is_drawn = drawn.ptr(y);
    const std::uint8_t *above = framed.ptr(y) + 1, *below = framed.ptr(y + 2) + 1;
    std::uint8_t* row = framed.ptr(y + 1) + 1;
    for (int x = 0; x < figure.cols; ++x) {
      if (!row[x] || !is_drawn[x] || 2 * own[x] >= best[x]) continue;
      const std::array<bool, 8> n = {above[x - 1] != 0, above[x] != 0, above[x + 1] != 0, row[x + 1] != 0,
                                     below[x + 1] != 0, below[x] != 0, below[x - 1] != 0, row[x - 1] != 0};
      if (isSimplePoint(n)) row[x] = 0;
    }
  }
  figure = framed(cv::Rect(1, 1, figure.cols, figure.rows)).clone();
}

// Background seen through a closed loop, such as between an arm and the body: not told from a white fill on
// white paper, but from fills on a coloured ground.
void openLoops(cv::Mat& figure, const cv::Mat& drawn, const Background& background) {
  const double chroma = std::hypot(background.coefficients(0, 1) - 128, background.coefficients(0, 2) - 128);
  const bool colored = chroma > 12 || background.coefficients(0, 0) < 160;
  const double figure_area = cv::countNonZero(figure);
  if (!colored || cv::countNonZero(drawn) < 0.7 * figure_area) return;
  cv::Mat labels, stats, centroids;
  cv::connectedComponentsWithStats(figure & ~drawn, labels, stats, centroids, 4, CV_32S);
  for (int y = 0; y < figure.rows; ++y) {
    const int* label = labels.ptr<int>(y);
    std::uint8_t* row = figure.ptr(y);
    for (int x = 0; x < figure.cols; ++x) {
      if (label[x] > 0 && stats.at<int>(label[x], cv::CC_STAT_AREA) > 0.003 * figure_area) {
        row[x] = 0;
      }
    }
  }
}

// Drops what lies along the border of the picture: the table, a finger, the next sheet.
void dropBorderStrips(cv::Mat& figure) {
  const int w = figure.cols, h = figure.rows;
  if (cv::countNonZero(figure.row(0)) + cv::countNonZero(figure.row(h - 1)) +
          cv::countNonZero(figure.col(0)) + cv::countNonZero(figure.col(w - 1)) ==
      0) {
    return;
  }
  cv::Mat labels, stats, centroids;
  const int count = cv::connectedComponentsWithStats(figure, labels, stats, centroids, 4, CV_32S);
  std::vector<int> contact(static_cast<std::size_t>(count), 0);
  for (int x = 0; x < w; ++x) {
    ++contact[static_cast<std::size_t>(labels.at<int>(0, x))];
    ++contact[static_cast<std::size_t>(labels.at<int>(h - 1, x))];
  }
  for (int y = 0; y < h; ++y) {
    ++contact[static_cast<std::size_t>(labels.at<int>(y, 0))];
    ++contact[static_cast<std::size_t>(labels.at<int>(y, w - 1))];
  }
  constexpr double kStrip = 3;  // contact over the root of the area; about 2 for a half figure
  for (int y = 0; y < h; ++y) {
    const int* label = labels.ptr<int>(y);
    std::uint8_t* row = figure.ptr(y);
    for (int x = 0; x < w; ++x) {
      if (label[x] > 0 && contact[static_cast<std::size_t>(label[x])] >
                              kStrip * std::sqrt(stats.at<int>(label[x], cv::CC_STAT_AREA))) {
        row[x] = 0;
      }
    }
  }
}

}  // namespace

Segmentation segment(const Image& image) {
  const cv::Mat rgb = reduced(image);
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
    openLoops(barrier, drawn, backgrounds.front());
    trimSoftEdge(barrier, drawn, cv::max(difference, contrast));
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
