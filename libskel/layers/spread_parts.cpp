// L. Grady, "Multilabel random walker image segmentation using prior models" (2005): the probability that a
// walker who starts at a px, and steps the more seldom the more colours change there, stops at a px of the
// part. He stops anywhere, as often as to come so far on flat ground; on lines, of which a net knows least,
// hardly.
#include "libskel/layers/spread_parts.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <span>

namespace skel {
namespace {

constexpr int kSpreadSize = 200;       // px, the long side of the figure
constexpr double kSpreadReach = .06;   // of the long side: how far a walker comes on flat ground
constexpr double kOpenContrast = .02;  // of the range of colours: what lets 1/e of the walkers through
// Where more than so much changes around, more by this of the rest: one line of many, in hatching, divides
// little.
constexpr double kFew = .45, kAmongOthers = .6;
constexpr double kAround = .03;      // of the long side, each way
constexpr double kLeastOpen = 1e-4;  // so many pass any line
constexpr int kTogether = 8;         // parts that are solved for in one pass over the factor

constexpr int kLeaf = 16;  // px: smaller boxes are not divided

using Factor = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Upper, Eigen::NaturalOrdering<int>>;
// Of one px, a number for each of some parts.
using Shares = Eigen::Array<double, kTogether, 1>;

// How many walkers each px lets through, 1 where it is flat, by how its change stands out.
cv::Mat openness(const cv::Mat& rgb, const cv::Mat& mask, double range, const cv::Size& size) {
  cv::Mat high, low, change, channels[3], open(size, CV_64F);
  cv::GaussianBlur(rgb, high, cv::Size(3, 3), 0);
  low = high.clone();
  const cv::Mat outside = mask == 0;
  high.setTo(cv::Scalar::all(0), outside), low.setTo(cv::Scalar::all(255), outside);
  cv::dilate(high, high, cv::Mat::ones(3, 3, CV_8U)), cv::erode(low, low, cv::Mat::ones(3, 3, CV_8U));
  cv::split(high - low, channels);
  change = cv::max(channels[0], cv::max(channels[1], channels[2]));
  cv::resize(change, change, size, 0, 0, cv::INTER_NEAREST);
  cv::Mat inside, on_figure, sums, counts;  // around each, in whole numbers
  cv::resize(mask, inside, size, 0, 0, cv::INTER_NEAREST);
  change.copyTo(on_figure, inside);
  const int window = 2 * std::max(1, cvRound(kAround * std::max(size.width, size.height))) + 1;
  const auto sumUp = [&](const cv::Mat& of, cv::Mat& sum) {
    cv::boxFilter(of, sum, CV_32S, cv::Size(window, window), cv::Point(-1, -1), false, cv::BORDER_CONSTANT);
  };
  sumUp(on_figure, sums), sumUp(inside != 0, counts);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const double mean = 255. * sums.at<int>(y, x) / std::max(255, counts.at<int>(y, x));
      const double contrast = kOpenContrast * range + kAmongOthers * std::max(0., mean - kFew * range);
      // Rounded to floats, the exponentials of all C libraries are the same.
      const auto through = static_cast<float>(std::exp(-change.at<std::uint8_t>(y, x) / contrast));
      open.at<double>(y, x) = std::max<double>(kLeastOpen, through);
    }
  return open;
}

// The px of a box in such an order that little of the factor fills in: those on both sides of a line, then
// those on it (A. George, "Nested dissection of a regular finite element mesh", 1973). `box`: of x + y and
// x - y, since slanting lines divide the same with fewer px.
void dissect(const cv::Mat& figure, const cv::Rect& box, std::vector<cv::Point>& order) {
  if (std::min(box.width, box.height) <= 1 || box.area() <= kLeaf) {
    for (int v = box.y; v < box.y + box.height; ++v)
      for (int u = box.x + ((box.x + v) & 1); u < box.x + box.width; u += 2) {
        const int x = (u + v) / 2, y = (u - v) / 2;
        const bool within = x >= 0 && y >= 0 && x < figure.cols && y < figure.rows;
        if (within && figure.at<std::uint8_t>(y, x) != 0) order.emplace_back(x, y);
      }
    return;
  }
  cv::Rect first = box, line = box, second = box;
  const auto divide = [&](int cv::Rect::*from, int cv::Rect::*length) {
    first.*length = box.*length / 2, line.*length = 1;
    line.*from += first.*length, second.*from = line.*from + 1;
    second.*length = box.*length - first.*length - 1;
  };
  if (box.width > box.height)
    divide(&cv::Rect::x, &cv::Rect::width);
  else
    divide(&cv::Rect::y, &cv::Rect::height);
  dissect(figure, first, order), dissect(figure, second, order), dissect(figure, line, order);
}

// From what is said of each px to how it spreads: Eigen's own solve() passes over the factor once a part.
void solve(const Factor& factor, std::vector<Shares>& shares) {
  const Eigen::SparseMatrix<double>& lower =
      factor.matrixL().nestedExpression();  // 1 on the diagonal, unsaid
  const auto diagonal = factor.vectorD();
  const int count = static_cast<int>(shares.size());
  const int *first = lower.outerIndexPtr(), *row = lower.innerIndexPtr();
  const double* value = lower.valuePtr();
  for (int j = 0; j < count; ++j) {
    const Shares own = shares[static_cast<std::size_t>(j)];
    for (int k = first[j]; k < first[j + 1]; ++k) shares[static_cast<std::size_t>(row[k])] -= value[k] * own;
  }
  for (int j = count - 1; j >= 0; --j) {
    Shares own = shares[static_cast<std::size_t>(j)] / diagonal[j];
    for (int k = first[j]; k < first[j + 1]; ++k) own -= value[k] * shares[static_cast<std::size_t>(row[k])];
    shares[static_cast<std::size_t>(j)] = own;
  }
}

}  // namespace

void spreadParts(const cv::Mat& rgb, const cv::Mat& mask, double range, std::vector<cv::Mat>& probabilities) {
  const double scale = std::min(1., static_cast<double>(kSpreadSize) / std::max(rgb.cols, rgb.rows));
  const cv::Size size(std::max(1, cvRound(rgb.cols * scale)), std::max(1, cvRound(rgb.rows * scale)));
  const cv::Mat open = openness(rgb, mask, range, size);
  cv::Mat seen, number(size, CV_32S, cv::Scalar(-1));
  cv::resize(mask, seen, size, 0, 0, cv::INTER_AREA);  // any of it
  std::vector<cv::Point> pixels;
  const int span = size.width + size.height;
  dissect(seen, cv::Rect(0, -size.height, span, span), pixels);
  for (std::size_t i = 0; i < pixels.size(); ++i) number.at<int>(pixels[i]) = static_cast<int>(i);

  const auto count = static_cast<Eigen::Index>(pixels.size());
  const double reach = kSpreadReach * std::max(size.width, size.height), stops = 1 / (reach * reach);
  Eigen::VectorXd own(count), sum(count);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(3 * pixels.size());
  for (Eigen::Index i = 0; i < count; ++i)
    sum[i] = own[i] = stops * open.at<double>(pixels[static_cast<std::size_t>(i)]);
  for (Eigen::Index i = 0; i < count; ++i)
    for (const cv::Point& step : {cv::Point(1, 0), cv::Point(0, 1)}) {
      const cv::Point from = pixels[static_cast<std::size_t>(i)], to = from + step;
      if (to.x >= size.width || to.y >= size.height || number.at<int>(to) < 0) continue;
      const Eigen::Index j = number.at<int>(to);
      const double passes = std::min(open.at<double>(from), open.at<double>(to));
      sum[i] += passes, sum[j] += passes;
      entries.emplace_back(std::min(i, j), std::max(i, j), -passes);  // the upper half
    }
  for (Eigen::Index i = 0; i < count; ++i) entries.emplace_back(i, i, sum[i]);
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Factor factor;
  if (count > 0) factor.compute(matrix);

  std::vector<cv::Mat*> there;
  for (cv::Mat& plane : probabilities)
    if (!plane.empty()) there.push_back(&plane);
  std::vector<Shares> shares(pixels.size());
  for (std::size_t first = 0; first < there.size(); first += kTogether) {
    const std::span<cv::Mat*> some(there.data() + first,
                                   std::min<std::size_t>(kTogether, there.size() - first));
    for (Shares& of_pixel : shares) of_pixel.setZero();
    for (std::size_t k = 0; k < some.size(); ++k) {
      cv::Mat small;
      cv::resize(*some[k], small, size, 0, 0, cv::INTER_LINEAR);
      for (std::size_t i = 0; i < pixels.size(); ++i)
        shares[i][static_cast<Eigen::Index>(k)] =
            own[static_cast<Eigen::Index>(i)] * static_cast<double>(small.at<float>(pixels[i]));
      *some[k] = small;
    }
    if (count > 0) solve(factor, shares);
    for (std::size_t k = 0; k < some.size(); ++k) {
      some[k]->setTo(0);
      for (std::size_t i = 0; i < pixels.size(); ++i)
        some[k]->at<float>(pixels[i]) = static_cast<float>(shares[i][static_cast<Eigen::Index>(k)]);
    }
  }
}

}  // namespace skel
