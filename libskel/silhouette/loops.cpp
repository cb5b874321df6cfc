#include "libskel/silhouette/loops.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "embedded/loop_net_weights.h"
#include "libskel/silhouette/components.h"

namespace skel {
namespace {

constexpr double kLeastLoop = 0.003;  // of the figure's area
constexpr double kStroke = 0.012;     // width of a line, share of the picture's long side
constexpr int kSeenInputs = 4;        // the last of kLoopInputs

constexpr const char* kLoopFormat = "skel-loop-net";

std::vector<std::string> loopInputs() { return {kLoopInputs.begin(), kLoopInputs.end()}; }

double greatest(const cv::Mat& values, const cv::Mat& where = {}) {
  double most = 0;
  cv::minMaxLoc(values, nullptr, &most, nullptr, nullptr, where.empty() ? cv::noArray() : where);
  return most;
}

double shareOf(const cv::Mat& part, const cv::Mat& whole) {
  return cv::countNonZero(part & whole) / std::max(1., static_cast<double>(cv::countNonZero(whole)));
}

}  // namespace

std::vector<Loop> findLoops(const Enclosed& enclosed) {
  const cv::Rect picture({}, enclosed.figure.size()), in_picture = cv::boundingRect(enclosed.figure);
  if (in_picture.empty()) return {};
  const int stroke = std::max(2, cvRound(kStroke * std::max(picture.width, picture.height)));
  const auto around = [&](const cv::Rect& box) {
    return box + cv::Size(4 * stroke, 4 * stroke) - cv::Point(2 * stroke, 2 * stroke);
  };
  // All that is looked at; places are of this from here on.
  const cv::Rect seen = around(in_picture) & picture, figure_box = in_picture - seen.tl();
  const cv::Mat figure = enclosed.figure(seen), ink = enclosed.drawn(seen),
                difference = enclosed.difference(seen);
  const double area = cv::countNonZero(figure);
  const cv::Mat open = figure & ~ink;
  cv::Mat labels;
  const std::vector<Component> parts = componentsOf(open, 4, labels);
  std::vector<int> large;
  double loop_area = 0;
  for (int label = 1; label < static_cast<int>(parts.size()); ++label) {
    const double own = parts[static_cast<std::size_t>(label)].area;
    if (own > kLeastLoop * area) large.push_back(label), loop_area += own;
  }
  if (large.empty()) return {};

  cv::Mat depth, width;  // px to what is not the figure, and to what is not open
  cv::distanceTransform(figure, depth, cv::DIST_L2, 3);
  cv::distanceTransform(open, width, cv::DIST_L2, 3);
  const double deepest = greatest(depth), widest = greatest(width), drawn = shareOf(ink, figure);
  std::vector<Loop> loops;
  for (const int label : large) {
    const Component& part = parts[static_cast<std::size_t>(label)];
    const cv::Rect box(part.x, part.y, part.width, part.height);
    const cv::Rect near = around(box) & cv::Rect({}, seen.size());
    const cv::Mat region = labels(near) == label;
    cv::Mat away;
    cv::distanceTransform(~region, away, cv::DIST_L2, 3);
    const cv::Mat beside = (away > 0) & (away <= stroke), beyond = (away > stroke) & (away <= 2 * stroke);
    const double own = part.area, half = greatest(width(near), region);
    Loop loop;
    for (int y = 0; y < region.rows; ++y)
      for (int x = 0; x < region.cols; ++x)
        if (region.at<std::uint8_t>(y, x))
          loop.pixels.push_back((seen.y + near.y + y) * picture.width + seen.x + near.x + x);
    loop.inputs = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(kLoopInputs.size()));
    loop.inputs.head(loop.inputs.size() - kSeenInputs) << std::log(own / area), std::log(half * half / area),
        half * half / own, own / box.area(), std::abs((part.centre_x - figure_box.x) / figure_box.width - .5),
        (part.centre_y - figure_box.y) / figure_box.height, static_cast<double>(box.width) / figure_box.width,
        static_cast<double>(box.height) / figure_box.height, greatest(depth(near), region) / deepest,
        half / widest, drawn, std::log(static_cast<double>(large.size())), loop_area / area,
        shareOf(depth(near) <= stroke, beside), shareOf(figure(near), beyond), shareOf(ink(near), beyond),
        shareOf(open(near), beyond), shareOf(ink(near), beside),
        cv::mean(difference(near), region)[0] / std::max(1., enclosed.different),
        static_cast<double>(enclosed.colored_ground), static_cast<double>(enclosed.paper);
    loops.push_back(std::move(loop));
  }
  return loops;
}

void lookInto(std::vector<Loop>& loops, const cv::Mat& figure, const cv::Mat& probability) {
  const double of_figure = cv::mean(probability, figure)[0];
  std::vector<float> seen;
  for (Loop& loop : loops) {
    seen.clear();
    double sum = 0;
    for (const int pixel : loop.pixels) {
      seen.push_back(probability.at<float>(pixel / probability.cols, pixel % probability.cols));
      sum += seen.back();
    }
    std::sort(seen.begin(), seen.end());
    const std::size_t fifth = seen.size() / 5;
    loop.inputs.tail(kSeenInputs) << sum / static_cast<double>(seen.size()), static_cast<double>(seen[fifth]),
        static_cast<double>(seen[seen.size() - 1 - fifth]), of_figure;
  }
}

void openLoops(const std::vector<Loop>& loops, const LoopNet& net, cv::Mat& figure) {
  for (const Loop& loop : loops) {
    if (net.net.probability(loop.inputs) <= kSurelyGround) continue;
    for (const int pixel : loop.pixels) figure.at<std::uint8_t>(pixel / figure.cols, pixel % figure.cols) = 0;
  }
}

cv::Mat chanceOfGround(const std::vector<Loop>& loops, const LoopNet& net, const cv::Mat& figure) {
  constexpr double kPerhaps = 0.2;
  cv::Mat chance;
  for (const Loop& loop : loops) {
    const double ground = net.net.probability(loop.inputs);
    if (ground <= kPerhaps || ground > kSurelyGround) continue;
    if (chance.empty()) chance = cv::Mat::zeros(figure.size(), CV_8U);
    for (const int pixel : loop.pixels) chance.data[pixel] = cv::saturate_cast<std::uint8_t>(255 * ground);
  }
  return chance;
}

LoopNet parseLoopNet(std::string_view text, const std::string& file) {
  LogisticNetFile parsed = parseLogisticNetFile(text, file, kLoopFormat, loopInputs());
  return {std::move(parsed.net), std::move(parsed.provenance)};
}

std::string formatLoopNet(const LoopNet& net) {
  return formatLogisticNetFile({net.net, net.provenance}, kLoopFormat, loopInputs());
}

const LoopNet& builtInLoopNet() {
  static const LoopNet net = parseLoopNet(embedded::loop_net_weights, "weights/loop_net.json (built in)");
  return net;
}

}  // namespace skel
