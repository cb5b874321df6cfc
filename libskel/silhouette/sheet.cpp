#include "libskel/silhouette/sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "libskel/silhouette/components.h"
#include "libskel/silhouette/levels.h"
#include "libskel/silhouette/strokes.h"

namespace skel {
namespace {

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
      // Less light takes from the chroma of paper what it takes from L + 16.
      constexpr float kBlack = 16 * 2.55f;
      const float light = std::min(1.0f, (static_cast<float>(row[x][0]) + kBlack) / (base[x][0] + kBlack));
      const cv::Vec3f d(static_cast<float>(row[x][0]) - base[x][0],
                        static_cast<float>(row[x][1]) - 128 - light * (base[x][1] - 128),
                        static_cast<float>(row[x][2]) - 128 - light * (base[x][2] - 128));
      const float squared = d[1] * d[1] + d[2] * d[2];
      color[x] = toByte(std::sqrt(d[0] * d[0] + squared));
      chroma[x] = toByte(std::sqrt(squared));
      darkness[x] = toByte(-255 * d[0] / std::max(1.0f, base[x][0]));
    }
  }
  return out;
}

// Shadows change the lightness alone and end at the border of the picture. If there is such an edge, all
// edges as steep as it is are dropped: together with limbs they would enclose paper.
void dropShadowEdges(cv::Mat& edges, const cv::Mat& dx, const cv::Mat& dy) {
  constexpr int kMaxChromaShare = 4;  // how many times the step of the lightness is that of the chroma
  cv::Mat steepness = cv::Mat::zeros(edges.size(), CV_32F);
  for (int y = 0; y < edges.rows; ++y) {
    const cv::Vec3s *x_row = dx.ptr<cv::Vec3s>(y), *y_row = dy.ptr<cv::Vec3s>(y);
    const std::uint8_t* edge = edges.ptr(y);
    float* out = steepness.ptr<float>(y);
    for (int x = 0; x < edges.cols; ++x) {
      if (!edge[x]) continue;
      std::array<float, 3> step;
      for (int c = 0; c < 3; ++c) step[c] = std::hypot(x_row[x][c], y_row[x][c]);
      if (kMaxChromaShare * std::max(step[1], step[2]) < step[0]) out[x] = step[0];
    }
  }
  cv::Mat labels;
  const std::vector<Component> lines = componentsOf(steepness > 0, 8, labels);
  constexpr int kMargin = 3;
  int longest = 0, length = std::max(edges.cols, edges.rows) / 10;
  for (int label = 1; label < static_cast<int>(lines.size()); ++label) {
    const Component& box = lines[static_cast<std::size_t>(label)];
    const bool ends_at_border = box.x < kMargin || box.y < kMargin ||
                                box.x + box.width > edges.cols - kMargin ||
                                box.y + box.height > edges.rows - kMargin;
    if (!ends_at_border || std::max(box.width, box.height) < length) continue;
    longest = label;
    length = std::max(box.width, box.height);
  }
  if (longest == 0) return;
  std::vector<float> steps;
  for (int y = 0; y < edges.rows; ++y) {
    for (int x = 0; x < edges.cols; ++x) {
      if (labels.at<int>(y, x) == longest) steps.push_back(steepness.at<float>(y, x));
    }
  }
  const double shadow = median(steps);
  edges &= ~((steepness > 0.6 * shadow) & (steepness < 1.6 * shadow));
}

}  // namespace

cv::Mat drawnOnPaper(const cv::Mat& lab, const cv::Mat& strokes, const cv::Mat& far) {
  cv::Mat covered;
  cv::dilate(strokes | far, covered, cv::Mat::ones(3, 3, CV_8U));
  const Differences differences = differencesFrom(lab, expectedColors(lab, covered));
  const Noise color = noiseOf(differences.color, covered), chroma = noiseOf(differences.chroma, covered);
  return (strokes & (differences.color > std::max(6.0, color.level + 3 * color.deviation))) |
         (differences.chroma > std::max(8.0, chroma.level + 5 * chroma.deviation)) |
         (differences.darkness > 128);
}

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
  dropShadowEdges(edges, dx, dy);
  return edges;
}

}  // namespace skel
