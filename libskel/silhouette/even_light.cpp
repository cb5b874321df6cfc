// The light is what varies slowly over the paper, colours are what jumps at edges (Retinex: E. Land,
// J. McCann, "Lightness and retinex theory", 1971; as a Poisson equation: B. Horn, "Determining lightness
// from an image", 1974). Around the figure it is the paper's colour; into the figure it is carried by the
// logarithm's gradients that are none of the drawing's.
#include "libskel/silhouette/even_light.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "libskel/core/check.h"
#include "libskel/silhouette/erase_line.h"
#include "libskel/silhouette/levels.h"
#include "libskel/silhouette/segment.h"
#include "libskel/silhouette/working_colors.h"

namespace skel {
namespace {

using Log3 = cv::Vec3f;  // natural logarithms of R, G, B

constexpr int kSurroundings_px = 200;   // long side of the surroundings in which the light is found, px
constexpr double kAround = 0.25;        // how far they reach beyond the figure, share of its long side
constexpr float kWhitePaper = 242;      // paper whose channels are more is white
constexpr double kFlat = 0.5;           // share of the ground that has one colour: it is no paper's
constexpr float kHue = 0.12f;           // how far the paper's hue strays, log of a ratio of channels
constexpr float kDarkest = 0.25f;       // paper in a shadow, of the paper's lightness
constexpr double kLeastPaper = 0.35;    // share of the ground
constexpr float kThinStroke = 0.05f;    // from which on what is thin and dark is drawn, log
constexpr float kSoft = 0.09f;          // the steepest gradient of light, log a px
constexpr float kGrey = 0.03f;          // and how far its channels differ
constexpr float kShadowHue = 0.25f;     // how far shadows change the hue, of how far they darken
constexpr double kCastShadow = 0.04;    // deviation of the light from a smooth one, log
constexpr float kPaperInLight = 0.05f;  // how far paper is from the light that is carried into the figure
constexpr float kPaperInShadow = 0.12f;
constexpr double kAcrossLine = 0.2;    // how firmly the light goes on across a line or another colour
constexpr double kAcrossEdge = 0.002;  // and where the step is that of a hard shadow or of greys

float mean(const Log3& v) { return (v[0] + v[1] + v[2]) / 3; }

// The surroundings of the figure, made smaller.
struct Surroundings {
  cv::Rect box;          // of the image
  cv::Mat colors;        // Log3
  cv::Mat figure, thin;  // 8-bit, 255: touched by the figure; thin dark strokes
  cv::Mat paper;         // 8-bit, 255 on paper beside the figure
  double scale() const { return static_cast<double>(box.width) / colors.cols; }
};

cv::Mat logOf(const cv::Mat& rgb) {
  static const std::array<float, 256> kLog = [] {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i)
      table[i] = static_cast<float>(std::log((static_cast<double>(i) + 0.5) / 255.5));
    return table;
  }();
  cv::Mat out(rgb.size(), CV_32FC3);
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x) {
      const cv::Vec3b& p = rgb.at<cv::Vec3b>(y, x);
      out.at<Log3>(y, x) = {kLog[p[0]], kLog[p[1]], kLog[p[2]]};
    }
  return out;
}

// A few thousand px of the ground.
struct Ground {
  std::vector<cv::Vec3b> colors;
  double flat = 0;  // share of the most frequent colour
};

Ground groundOf(const Image& image, const Plane8& figure, const cv::Rect& box) {
  Ground ground;
  const int step = std::max(1, std::max(box.width, box.height) / 60);
  std::vector<std::uint32_t> codes;
  for (int y = box.y + step / 2; y < box.br().y; y += step)
    for (int x = box.x + step / 2; x < box.br().x; x += step) {
      if (figure(y, x) != 0) continue;
      const std::uint8_t* p = image.pixel(x, y);
      ground.colors.emplace_back(p[0], p[1], p[2]);
      codes.push_back(p[0] << 16 | p[1] << 8 | p[2]);
    }
  std::sort(codes.begin(), codes.end());
  std::size_t most = 0, run = 0;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    run = i > 0 && codes[i] == codes[i - 1] ? run + 1 : 1;
    most = std::max(most, run);
  }
  ground.flat = static_cast<double>(most) / static_cast<double>(std::max<std::size_t>(1, codes.size()));
  return ground;
}

// Paper and cameras are never as smooth as what was made on a screen, compressed or not: how far places of
// the ground are from the mean of the four beside them, levels.
bool hasGrain(const Image& image, const Plane8& figure, const cv::Rect& box) {
  constexpr float kGrain = 0.25f;
  const int cell = std::max(1, std::max(box.width, box.height) / kSurroundings_px);
  const int step = std::max(3 * cell, std::max(box.width, box.height) / 30);
  const auto level = [&](int x0, int y0) {
    int sum = 0;
    for (int y = y0; y < y0 + cell; ++y)
      for (int x = x0; x < x0 + cell; ++x) {
        const std::uint8_t* p = image.pixel(x, y);
        sum += p[0] + p[1] + p[2];
      }
    return static_cast<float>(sum) / static_cast<float>(3 * cell * cell);
  };
  std::vector<float> apart;
  for (int y = box.y + cell; y + 2 * cell <= box.br().y; y += step)
    for (int x = box.x + cell; x + 2 * cell <= box.br().x; x += step) {
      if ((figure.block(y - cell, x - cell, 3 * cell, 3 * cell) != 0).any()) continue;
      const float beside = level(x - cell, y) + level(x + cell, y) + level(x, y - cell) + level(x, y + cell);
      apart.push_back(std::abs(level(x, y) - beside / 4));
    }
  if (apart.empty()) return false;
  const auto upper = apart.begin() + static_cast<std::ptrdiff_t>(apart.size() * 3 / 4);
  std::nth_element(apart.begin(), upper, apart.end());
  return *upper > kGrain;
}

// The colour of the paper where it is lit: the most frequent hue of the lighter half. Nothing if that is the
// hue of no paper.
std::optional<Log3> paperColor(const Ground& ground) {
  if (ground.colors.size() < 100) return {};
  cv::Mat rgb(1, static_cast<int>(ground.colors.size()), CV_8UC3,
              const_cast<cv::Vec3b*>(ground.colors.data()));
  const cv::Mat logs = logOf(rgb);
  std::vector<float> lightness;
  for (int i = 0; i < logs.cols; ++i) lightness.push_back(mean(logs.at<Log3>(i)));
  std::vector<float> sorted = lightness;
  const float half = static_cast<float>(median(sorted));
  constexpr int kBins = 64;
  constexpr float kBin = 0.05f;
  std::array<std::vector<int>, kBins * kBins> members;
  const auto bin = [&](float ratio) {
    return std::clamp(static_cast<int>(std::floor(ratio / kBin)) + kBins / 2, 0, kBins - 1);
  };
  for (int i = 0; i < logs.cols; ++i) {
    const Log3& c = logs.at<Log3>(i);
    if (lightness[static_cast<std::size_t>(i)] < half) continue;
    members[static_cast<std::size_t>(bin(c[0] - c[1]) * kBins + bin(c[2] - c[1]))].push_back(i);
  }
  const auto best = std::max_element(members.begin(), members.end(),
                                     [](const auto& a, const auto& b) { return a.size() < b.size(); });
  std::array<std::vector<float>, 3> channels;
  for (const int i : *best)
    for (int c = 0; c < 3; ++c) channels[static_cast<std::size_t>(c)].push_back(logs.at<Log3>(i)[c]);
  Log3 paper;
  for (int c = 0; c < 3; ++c) paper[c] = static_cast<float>(median(channels[static_cast<std::size_t>(c)]));
  constexpr float kMostTint = 0.35f;
  const float red = paper[0] - paper[1], blue = paper[2] - paper[1];
  if (mean(paper) < std::log(kDarkest) || std::abs(red) > kMostTint / 2 || std::abs(blue) > kMostTint)
    return {};
  return paper;
}

bool isPaper(const Log3& color, const Log3& paper) {
  const float darker = mean(paper) - mean(color), most = kHue + kShadowHue * std::max(0.0f, darker);
  return darker < -std::log(kDarkest) && std::abs(color[0] - color[1] - paper[0] + paper[1]) < most &&
         std::abs(color[2] - color[1] - paper[2] + paper[1]) < most;
}

Surroundings surroundingsOf(const Image& image, const Plane8& figure, const cv::Rect& box,
                            const Log3& paper) {
  Surroundings out;
  out.box = box;
  const double scale = std::max(1.0, std::max(box.width, box.height) / double(kSurroundings_px));
  const cv::Size size(std::max(1, cvRound(box.width / scale)), std::max(1, cvRound(box.height / scale)));
  cv::Mat rgba, rgb(size, CV_8UC3);
  cv::resize(rgbaOf(image)(box), rgba, size, 0, 0, cv::INTER_AREA);
  cv::mixChannels(rgba, rgb, {0, 0, 1, 1, 2, 2});
  out.colors = logOf(rgb);
  const cv::Mat mask = viewOf(figure);
  cv::resize(mask(box), out.figure, size, 0, 0, cv::INTER_AREA);
  out.figure = out.figure > 0;

  cv::Mat lightness(size, CV_32F), closed;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const Log3& c = out.colors.at<Log3>(y, x);
      lightness.at<float>(y, x) = std::min({c[0], c[1], c[2]});
    }
  constexpr int kWidest = 7;
  cv::morphologyEx(lightness, closed, cv::MORPH_CLOSE, cv::Mat::ones(kWidest, kWidest, CV_8U));
  out.thin = closed - lightness > kThinStroke;
  cv::Mat beside;
  cv::dilate(out.figure, beside, cv::Mat::ones(3, 3, CV_8U));
  out.paper = cv::Mat::zeros(size, CV_8U);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      if (!beside.at<std::uint8_t>(y, x) && !out.thin.at<std::uint8_t>(y, x) &&
          isPaper(out.colors.at<Log3>(y, x), paper))
        out.paper.at<std::uint8_t>(y, x) = 255;
  return out;
}

// Light that changes as a quadratic polynomial of the place, fitted robustly to the paper.
struct SmoothLight {
  Eigen::Matrix<double, 6, 3> coefficients;
  double deviation = 0;  // of the paper from it, of the mean of the channels

  static Eigen::Matrix<double, 1, 6> basis(double u, double v) {
    return (Eigen::Matrix<double, 1, 6>() << 1, u, v, u * u, u * v, v * v).finished();
  }
  Log3 at(double u, double v) const {
    const Eigen::Matrix<double, 1, 3> c = basis(u, v) * coefficients;
    return {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])};
  }
};

Eigen::Vector2d unit(int x, int y, const cv::Size& size) {
  return {2.0 * x / size.width - 1, 2.0 * y / size.height - 1};
}

SmoothLight smoothLight(const Surroundings& around) {
  SmoothLight light;
  light.coefficients.setZero();
  const cv::Size size = around.colors.size();
  double scale = 1e9;
  constexpr int kPasses = 5;
  for (int pass = 0; pass < kPasses; ++pass) {
    Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 3> right = Eigen::Matrix<double, 6, 3>::Zero();
    std::vector<float> strays;
    double squares = 0, count = 0;
    for (int y = 0; y < size.height; y += 2)
      for (int x = 0; x < size.width; x += 2) {
        if (!around.paper.at<std::uint8_t>(y, x)) continue;
        const Eigen::Vector2d place = unit(x, y, size);
        const Eigen::Matrix<double, 1, 6> b = SmoothLight::basis(place.x(), place.y());
        const Log3& c = around.colors.at<Log3>(y, x);
        const double stray = mean(c) - (b * light.coefficients).mean();
        const double t = std::min(1.0, std::abs(stray) / scale), weight = (1 - t * t) * (1 - t * t);
        strays.push_back(static_cast<float>(std::abs(stray)));
        squares += stray * stray, ++count;
        normal += weight * b.transpose() * b;
        right += weight * b.transpose() * Eigen::RowVector3d(c[0], c[1], c[2]);
      }
    light.deviation = std::sqrt(squares / std::max(1.0, count));
    // What lies beyond the paper on one side would be anybody's guess.
    Eigen::Matrix<double, 6, 1> ridge;
    ridge << 1e-6, 1e-3, 1e-3, 1e-2, 1e-2, 1e-2;
    normal += Eigen::Matrix<double, 6, 6>(ridge.asDiagonal()) * std::max(1.0, count);
    light.coefficients = normal.ldlt().solve(right);
    if (pass > 0) scale = std::max(0.05, 4 * median(strays));
  }
  return light;
}

// No part of the figure is lit more or less than the paper around it.
void keepWithin(const Surroundings& around, cv::Mat& light) {
  Log3 least = Log3::all(0), most = Log3::all(std::log(0.5f / 255.5f));
  cv::Mat beside;
  constexpr int kNear = 12;
  cv::dilate(around.figure, beside, cv::Mat::ones(2 * kNear + 1, 2 * kNear + 1, CV_8U));
  for (int y = 0; y < light.rows; ++y)
    for (int x = 0; x < light.cols; ++x) {
      if (!beside.at<std::uint8_t>(y, x) || !around.paper.at<std::uint8_t>(y, x)) continue;
      for (int c = 0; c < 3; ++c) {
        least[c] = std::min(least[c], light.at<Log3>(y, x)[c]);
        most[c] = std::max(most[c], light.at<Log3>(y, x)[c]);
      }
    }
  constexpr float kBeyond = 0.05f;
  for (int y = 0; y < light.rows; ++y)
    for (int x = 0; x < light.cols; ++x)
      for (int c = 0; c < 3; ++c) {
        float& l = light.at<Log3>(y, x)[c];
        l = std::clamp(l, least[c] - kBeyond, std::max(least[c], most[c]) + kBeyond);
      }
}

// Within the figure, what hardly differs from the paper is paper: its light is known. `most`: by how much its
// mean differs.
void snapToPaper(const Surroundings& around, float most, cv::Mat& light) {
  const cv::Size size = light.size();
  cv::Mat stray = cv::Mat::zeros(size, CV_32FC3), weight = cv::Mat::zeros(size, CV_32F);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      if (!around.figure.at<std::uint8_t>(y, x) || around.thin.at<std::uint8_t>(y, x)) continue;
      const Log3 apart = around.colors.at<Log3>(y, x) - light.at<Log3>(y, x);
      const float grey = mean(apart);
      if (std::abs(grey) > most || std::abs(apart[0] - grey) > kGrey || std::abs(apart[2] - grey) > kGrey)
        continue;
      stray.at<Log3>(y, x) = apart;
      weight.at<float>(y, x) = 1;
    }
  constexpr double kReach = 2.5;
  constexpr float kFew = 0.2f;
  cv::GaussianBlur(stray, stray, cv::Size(), kReach);
  cv::GaussianBlur(weight, weight, cv::Size(), kReach);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      light.at<Log3>(y, x) += stray.at<Log3>(y, x) / (weight.at<float>(y, x) + kFew);
}

// The logarithm of the light everywhere in the surroundings that the figure touches.
cv::Mat carriedLight(const Surroundings& around, const SmoothLight& smooth) {
  const cv::Size size = around.colors.size();
  cv::Mat domain;
  constexpr int kBand = 5;
  cv::dilate(around.figure, domain,
             cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * kBand + 1, 2 * kBand + 1)));
  cv::Mat weight, known;  // the paper's light without its grain
  around.paper.convertTo(weight, CV_32F, 1 / 255.);
  cv::Mat weighted(size, CV_32FC3);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      weighted.at<Log3>(y, x) = around.colors.at<Log3>(y, x) * weight.at<float>(y, x);
  cv::blur(weighted, known, cv::Size(3, 3));
  cv::blur(weight, weight, cv::Size(3, 3));

  cv::Mat light(size, CV_32FC3), index(size, CV_32S, cv::Scalar(-1));
  std::vector<cv::Point> unknown;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const Eigen::Vector2d place = unit(x, y, size);
      light.at<Log3>(y, x) = smooth.at(place.x(), place.y());
      if (around.paper.at<std::uint8_t>(y, x)) {
        light.at<Log3>(y, x) = known.at<Log3>(y, x) / weight.at<float>(y, x);
      } else if (domain.at<std::uint8_t>(y, x)) {
        index.at<int>(y, x) = static_cast<int>(unknown.size());
        unknown.emplace_back(x, y);
      }
    }
  if (unknown.empty()) return light;

  const bool shadows = smooth.deviation > kCastShadow;
  const int count = static_cast<int>(unknown.size());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(unknown.size() * 5);
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(count, 3);
  Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(count, 1e-6);
  const auto join = [&](const cv::Point& a, const cv::Point& b) {
    const int i = index.at<int>(a), j = index.at<int>(b);
    if ((i < 0 && j < 0) || !domain.at<std::uint8_t>(a) || !domain.at<std::uint8_t>(b)) return;
    const Eigen::Vector2d at_a = unit(a.x, a.y, size), at_b = unit(b.x, b.y, size);
    Log3 step = smooth.at(at_b.x(), at_b.y()) - smooth.at(at_a.x(), at_a.y());
    double firm = 1;
    if (shadows) {
      const Log3 drawn = around.colors.at<Log3>(b) - around.colors.at<Log3>(a);
      const float grey = mean(drawn);
      const float most = kGrey + kShadowHue * std::abs(grey);
      const bool isGrey = std::abs(drawn[0] - grey) < most && std::abs(drawn[2] - grey) < most;
      const bool soft = isGrey && std::abs(grey) < kSoft;
      const bool line = around.thin.at<std::uint8_t>(a) || around.thin.at<std::uint8_t>(b);
      if (soft && !line)
        step = drawn;
      else
        firm = line || !isGrey ? kAcrossLine : kAcrossEdge;
    }
    const auto half = [&](int own, int other, const cv::Point& other_place, double sign) {
      if (own < 0) return;
      diagonal[own] += firm;
      for (int c = 0; c < 3; ++c) {
        right(own, c) -= sign * firm * step[c];
        if (other < 0) right(own, c) += firm * light.at<Log3>(other_place)[c];
      }
      if (other >= 0 && other < own) entries.emplace_back(own, other, -firm);
    };
    half(i, j, b, 1);
    half(j, i, a, -1);
  };
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      if (x + 1 < size.width) join({x, y}, {x + 1, y});
      if (y + 1 < size.height) join({x, y}, {x, y + 1});
    }
  for (int i = 0; i < count; ++i) {
    entries.emplace_back(i, i, diagonal[i]);
    for (int c = 0; c < 3; ++c) right(i, c) += 1e-6 * light.at<Log3>(unknown[static_cast<std::size_t>(i)])[c];
  }
  Eigen::SparseMatrix<double> laplacian(count, count);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(laplacian);
  SKEL_CHECK(solver.info() == Eigen::Success);
  const Eigen::MatrixX3d solved = solver.solve(right);
  for (int i = 0; i < count; ++i)
    for (int c = 0; c < 3; ++c)
      light.at<Log3>(unknown[static_cast<std::size_t>(i)])[c] = static_cast<float>(solved(i, c));
  keepWithin(around, light);
  snapToPaper(around, shadows ? kPaperInShadow : kPaperInLight, light);
  return light;
}

// Divides the figure and what is around it by the light.
void divide(const Surroundings& around, const cv::Mat& light, Image& image) {
  constexpr float kMostGain = 5;
  cv::Mat gain(light.size(), CV_32FC3);
  for (int y = 0; y < light.rows; ++y)
    for (int x = 0; x < light.cols; ++x)
      for (int c = 0; c < 3; ++c)
        gain.at<Log3>(y, x)[c] = std::min(kMostGain, std::exp(-light.at<Log3>(y, x)[c]));
  const double scale = around.scale(), scale_y = double(around.box.height) / light.rows;
  const auto across = [&](int v, std::vector<Log3>& row) {
    for (int x = 0; x < around.box.width; ++x) {
      const double u = std::clamp((x + 0.5) / scale - 0.5, 0.0, light.cols - 1.0);
      const int u0 = std::min(static_cast<int>(u), std::max(0, light.cols - 2)),
                u1 = std::min(u0 + 1, light.cols - 1);
      const float fu = static_cast<float>(u - u0);
      row[static_cast<std::size_t>(x)] = gain.at<Log3>(v, u0) * (1 - fu) + gain.at<Log3>(v, u1) * fu;
    }
  };
  std::vector<Log3> above(static_cast<std::size_t>(around.box.width)), below = above;
  for (int y = 0, last = -1; y < around.box.height; ++y) {
    const double v = std::clamp((y + 0.5) / scale_y - 0.5, 0.0, light.rows - 1.0);
    const int v0 = std::min(static_cast<int>(v), std::max(0, light.rows - 2));
    if (v0 != last) across(v0, above), across(std::min(v0 + 1, light.rows - 1), below);
    last = v0;
    const float fv = static_cast<float>(v - v0);
    std::uint8_t* p = image.pixel(around.box.x, around.box.y + y);
    for (std::size_t x = 0; x < above.size(); ++x, p += 4)
      for (int c = 0; c < 3; ++c) p[c] = toByte(p[c] * (above[x][c] * (1 - fv) + below[x][c] * fv));
  }
}

// The figure's box and as much beside it as is looked at.
cv::Rect boxAround(const Polygon& outline) {
  Eigen::Vector2d low = outline.front(), high = low;
  for (const Eigen::Vector2d& p : outline) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double margin = std::max(8., kAround * (high - low).maxCoeff());
  const cv::Point corner(cvFloor(low.x() - margin), cvFloor(low.y() - margin)),
      other(cvCeil(high.x() + margin), cvCeil(high.y() + margin));
  return {corner, other};
}

// Whether the paper is white and evenly lit.
bool isWhite(const Surroundings& around) {
  std::vector<float> levels;
  for (int y = 0; y < around.colors.rows; ++y)
    for (int x = 0; x < around.colors.cols; ++x) {
      const Log3& c = around.colors.at<Log3>(y, x);
      if (around.paper.at<std::uint8_t>(y, x)) levels.push_back(std::min({c[0], c[1], c[2]}));
    }
  if (levels.empty()) return true;
  const auto low = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 20);
  std::nth_element(levels.begin(), low, levels.end());
  return *low > std::log(kWhitePaper / 255);
}

}  // namespace

Image evenLight(const Image& image, const Silhouette& silhouette) {
  SKEL_CHECK(silhouette.found());
  const Plane8& figure = silhouette.mask;
  SKEL_CHECK_EQ(figure.rows(), image.height);
  SKEL_CHECK_EQ(figure.cols(), image.width);
  const cv::Rect box = boxAround(silhouette.outline.front()) & cv::Rect(0, 0, image.width, image.height);
  const Ground ground = groundOf(image, figure, box);
  constexpr std::size_t kManyLines = 8;  // one or two may be drawn
  const bool ruled = silhouette.ruling && silhouette.ruling->size() >= kManyLines;
  const bool grain = ground.flat < kFlat && hasGrain(image, figure, box);
  if ((!grain && !ruled) || image.rgba.col(3).minCoeff() < 255) return {};
  const std::optional<Log3> paper = paperColor(ground);
  if (!paper) return {};

  Image even = image;
  const double line_px =
      std::max(1.0, std::max(image.width, image.height) / static_cast<double>(kWorkingSize));
  bool changed = false;
  for (const RuledLine& line : silhouette.ruling ? *silhouette.ruling : rulingOf(image))
    changed |= eraseLine(line, figure, {box.x, box.y, box.width, box.height}, line_px, even);
  if (grain) {
    const Surroundings around = surroundingsOf(even, figure, box, *paper);
    const int ground_px = static_cast<int>(around.figure.total()) - cv::countNonZero(around.figure);
    if (cv::countNonZero(around.paper) > kLeastPaper * ground_px && !isWhite(around)) {
      divide(around, carriedLight(around, smoothLight(around)), even);
      changed = true;
    }
  }
  return changed ? even : Image();
}

}  // namespace skel
