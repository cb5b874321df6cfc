#include "libskel/jointnet/tree_recognizer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "libskel/core/check.h"
#include "libskel/jointnet/tree_search.h"

namespace skel {
namespace {

using Vec = Eigen::Vector2d;

constexpr int kLongSide = 128;
constexpr double kNear = .1 * kLongSide / 4;  // cells: what counts as found
// Drawings stand upright but for few, which lie, stand on their heads or are scanned sideways. The net has
// learned to tell upright figures from turned ones: above kSurelyUpright (log-odds) nothing else is looked
// at; a turn needs log-odds of at least kTurnLogit, and has to be ahead of the picture as it is by
// kTurnMargin, by kEighthTurn more if it is no quarter turn. Log-odds count within ±kLargestLogit, and each
// nat of the heatmaps' mean entropy counts as much as kEntropyShare of them against a view.
constexpr double kSurelyUpright = 4.5, kTurnLogit = 0, kTurnMargin = 1.5, kEighthTurn = 3;
constexpr double kEntropyShare = 2, kLargestLogit = 6;
constexpr int kOrientations = 8;

// The figure's likeness: logistic in the net's log-odds of a whole figure (within ±kLargestLogit) and in
// the joints' mean mass. The constant lets most hand-drawn figures exceed 0.5 that the nets have not
// been trained on, which are less clear than generated ones; both built-in nets want the same.
constexpr double kFigureLogit = .9, kFigureJoints = 8, kFigureConstant = -9;
// Off the log-odds of a figure that was turned: of eight views of an animal one may look human.
constexpr double kTurnedOdds = 1.5;

struct Heatmaps {
  std::vector<Heatmap> joints;  // probabilities, each sums to 1
  std::vector<double> entropies, disagreements;
  double figure_logit = 0;
  double entropy = 0;
};

// Of a joint's logits in the net's last map.
double logSumExp(const float* map, int channels, int joint) {
  float highest = -std::numeric_limits<float>::infinity();
  const auto each = [&](const auto& take) {
    for (int y = 0; y < kHeatmapSize; ++y)
      for (int x = 0; x < kHeatmapSize; ++x)
        take(map[static_cast<std::size_t>(paddedIndex(kHeatmapSize, y, x)) * channels + joint]);
  };
  each([&](float l) { highest = std::max(highest, l); });
  double sum = 0;
  each([&](float l) { sum += std::exp(l - highest); });
  return highest + std::log(sum);
}

// Logits averaged over one or two passes, then softmax.
Heatmaps evaluateNet(const Plane8& mask, const FigureLook& look, const JointNet& net, const NetJoints& joints,
                     InstructionSet set, bool mirror) {
  const int count = joints.count(), channels = heatmapChannels(count), figure_channel = net.figureChannel();
  Heatmaps out;
  out.joints.assign(static_cast<std::size_t>(count), Heatmap{});
  out.entropies.assign(out.joints.size(), 0);
  out.disagreements.assign(out.joints.size(), 0);
  ConvNetMaps maps(net);
  const int passes = mirror ? 2 : 1;
  for (int pass = 0; pass < passes; ++pass) {
    const bool mirrored = pass == 1;
    encodeJointNetInput(mask, look, FramePlacement::centred(mask, mirrored), net.maps[0].channels,
                        maps.maps[0]);
    forward(net, set, maps);
    const float* map = maps.maps.back().data();
    for (int y = 0; y < kHeatmapSize; ++y) {
      for (int x = 0; x < kHeatmapSize; ++x) {
        const float* a = map + static_cast<std::size_t>(paddedIndex(kHeatmapSize, y, x)) * channels;
        const int cell = y * kHeatmapSize + (mirrored ? kHeatmapSize - 1 - x : x);
        for (int j = 0; j < count; ++j)
          out.joints[mirrored ? joints.mirrored[j] : j][cell] += a[j] / static_cast<float>(passes);
        out.figure_logit += a[figure_channel] / (static_cast<double>(kHeatmapCells) * passes);
      }
    }
    if (mirror)
      for (int j = 0; j < count; ++j)
        out.disagreements[mirrored ? joints.mirrored[j] : j] += logSumExp(map, channels, j) / passes;
  }
  for (int j = 0; j < count; ++j) {
    Heatmap& map = out.joints[j];
    const float highest = *std::max_element(map.begin(), map.end());
    double sum = 0, mean = 0;  // of e^l and of l·e^l, l relative to the highest
    for (float& v : map) {
      const float l = v - highest;
      v = std::exp(l);
      sum += v;
      mean += static_cast<double>(l) * v;
    }
    for (float& v : map) v /= static_cast<float>(sum);
    out.entropies[j] = std::log(sum) - mean / sum;
    out.entropy += out.entropies[j] / count;
    // The overlap of p and q, the sum of sqrt(p·q), is that of the exponentials of the mean logits over the
    // root of both sums.
    if (mirror) out.disagreements[j] = std::max(0., out.disagreements[j] - (highest + std::log(sum)));
  }
  return out;
}

double figureLogit(const Heatmaps& maps) {
  return std::clamp(maps.figure_logit, -kLargestLogit, kLargestLogit);
}

// How much speaks for a view.
double evidence(const Heatmaps& maps) { return figureLogit(maps) - kEntropyShare * maps.entropy; }

// The figure turned by `angle` about its middle and scaled so that it fits the grid again.
struct Turned {
  Plane8 mask;
  FigureLook look;
  Eigen::Matrix2d original_from_turned = Eigen::Matrix2d::Identity();
  Vec shift = Vec::Zero();  // original grid px = original_from_turned · turned px + shift

  Vec original(const Vec& p) const { return original_from_turned * p + shift; }
};

Turned turnedBy(const Plane8& mask, const FigureLook& look, double angle) {
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
  Vec low = Vec::Constant(1e9), high = Vec::Constant(-1e9);
  for (int y = 0; y < mask.rows(); ++y) {
    for (int x = 0; x < mask.cols(); ++x) {
      if (mask(y, x) == 0) continue;
      const Vec p = turn * Vec(x, y);
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  const Vec size = high - low + Vec::Ones();
  const double scale = size.maxCoeff() / kLongSide;  // original px a turned px
  Turned out;
  const int width = std::clamp(static_cast<int>(std::lround(size.x() / scale)), 1, kLongSide);
  const int height = std::clamp(static_cast<int>(std::lround(size.y() / scale)), 1, kLongSide);
  out.original_from_turned = turn.transpose() * scale;
  out.shift = turn.transpose() * (low + Vec::Constant((scale - 1) / 2));
  out.mask = Plane8::Zero(height, width);
  if (look.known()) {
    out.look.lines = Plane8::Zero(height, width);
    out.look.tones.fill(Plane8::Constant(height, width, kMeanTone));
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Vec p = out.original(Vec(x, y));
      const int px = static_cast<int>(std::lround(p.x())), py = static_cast<int>(std::lround(p.y()));
      if (px < 0 || py < 0 || px >= mask.cols() || py >= mask.rows() || mask(py, px) == 0) continue;
      out.mask(y, x) = 255;
      if (!look.known()) continue;
      out.look.lines(y, x) = look.lines(py, px);
      for (std::size_t k = 0; k < 3; ++k) out.look.tones[k](y, x) = look.tones[k](py, px);
    }
  }
  return out;
}

// The mean cell of the heatmap around a cell.
Vec refined(const Heatmap& map, int cell) {
  const int cx = cell % kHeatmapSize, cy = cell / kHeatmapSize;
  Vec sum = Vec::Zero();
  double weight = 0;
  for (int y = std::max(0, cy - 2); y <= std::min(kHeatmapSize - 1, cy + 2); ++y) {
    for (int x = std::max(0, cx - 2); x <= std::min(kHeatmapSize - 1, cx + 2); ++x) {
      const double p = map[y * kHeatmapSize + x];
      sum += p * Vec(x, y);
      weight += p;
    }
  }
  return weight > 0 ? Vec(sum / weight) : Vec(cx, cy);
}

// Probability that the joint is within kNear of a place.
double massAround(const Heatmap& map, const Vec& centre) {
  double mass = 0;
  const auto first = [](double c) { return std::max(0, static_cast<int>(std::ceil(c - kNear))); };
  const auto last = [](double c) {
    return std::min(kHeatmapSize - 1, static_cast<int>(std::floor(c + kNear)));
  };
  for (int y = first(centre.y()); y <= last(centre.y()); ++y) {
    for (int x = first(centre.x()); x <= last(centre.x()); ++x) {
      if ((Vec(x, y) - centre).squaredNorm() <= kNear * kNear) mass += map[y * kHeatmapSize + x];
    }
  }
  return mass;
}

// Around the likeliest cell that lies 2·kNear away.
double rivalMass(const Heatmap& map, const Vec& centre) {
  int best = -1;
  for (int i = 0; i < kHeatmapCells; ++i) {
    const Vec cell(i % kHeatmapSize, i / kHeatmapSize);
    if ((cell - centre).squaredNorm() >= 4 * kNear * kNear && (best < 0 || map[i] > map[best])) best = i;
  }
  return best < 0 ? 0 : massAround(map, Vec(best % kHeatmapSize, best / kHeatmapSize));
}

// The nearest point of the figure; itself if it lies in it.
Vec insideFigure(const Plane8& mask, const Vec& p) {
  const int px = static_cast<int>(std::lround(p.x())), py = static_cast<int>(std::lround(p.y()));
  if (px >= 0 && py >= 0 && px < mask.cols() && py < mask.rows() && mask(py, px) != 0) return p;
  Vec best = p;
  double nearest = std::numeric_limits<double>::infinity();
  for (int y = 0; y < mask.rows(); ++y) {
    for (int x = 0; x < mask.cols(); ++x) {
      const double d = (Vec(x, y) - p).squaredNorm();
      if (mask(y, x) != 0 && d < nearest) nearest = d, best = Vec(x, y);
    }
  }
  return best;
}

}  // namespace

TreeRecognition recognizeByJointNet(const Plane8& mask, const FigureLook& look, const JointNet& net,
                                    const NetJoints& joints, const TreeRecognizerOptions& options) {
  SKEL_CHECK((mask != 0).any());
  SKEL_CHECK_EQ(joints.names.size(), net.joints.size());
  const auto evaluate = [&](const Turned& figure, bool mirror) {
    return evaluateNet(figure.mask, figure.look, net, joints, options.instructions, mirror);
  };
  Turned figure{mask, look, Eigen::Matrix2d::Identity(), Vec::Zero()};
  Heatmaps maps = evaluate(figure, options.mirror);
  TreeRecognition result;
  if (options.try_orientations && maps.figure_logit < kSurelyUpright) {
    double most = evidence(maps) + kTurnMargin;
    for (int k = 1; k < kOrientations; ++k) {
      if (k % 2 == 1 && maps.figure_logit > kTurnLogit) continue;
      const double angle = 2 * std::numbers::pi * k / kOrientations;
      Turned turned = turnedBy(mask, look, -angle);
      const Heatmaps view = evaluate(turned, false);
      const double speaks = evidence(view) - (k % 2 == 0 ? 0 : kEighthTurn);
      if (view.figure_logit < kTurnLogit || speaks <= most) continue;
      most = speaks;
      result.turned = angle;
      figure = std::move(turned);
    }
    if (result.turned != 0) maps = evaluate(figure, options.mirror);
  }
  // Of the two passes' placements the mean.
  const FramePlacement one = FramePlacement::centred(figure.mask);
  const FramePlacement other = FramePlacement::centred(figure.mask, options.mirror);
  const Vec offset((one.offset_x + other.offset_x) / 2., one.offset_y);
  const std::vector<int> cells = searchTree(figure.mask, offset, maps.joints, joints, net.bones);
  result.joints.resize(cells.size());
  double mean_mass = 0;
  for (int j = 0; j < joints.count(); ++j) {
    const Vec cell = refined(maps.joints[j], cells[j]);
    const Vec at = insideFigure(figure.mask, frameFromCell(cell) - offset);
    TreeJoint& joint = result.joints[j];
    const Heatmap& map = maps.joints[j];
    joint.position = insideFigure(mask, figure.original(at));
    joint.mass = massAround(map, cell);
    joint.rival = rivalMass(map, cell);
    if (joints.mirrored[j] != j) joint.counterpart = massAround(maps.joints[joints.mirrored[j]], cell);
    joint.entropy = maps.entropies[j];
    joint.likelihood =
        std::log(static_cast<double>(map[cells[j]]) / *std::max_element(map.begin(), map.end()));
    joint.disagreement = maps.disagreements[j];
    mean_mass += joint.mass / joints.count();
  }
  result.figure_logit = maps.figure_logit;
  result.entropy = maps.entropy;
  const double logit = kFigureLogit * figureLogit(maps) + kFigureJoints * mean_mass + kFigureConstant -
                       (result.turned != 0 ? kTurnedOdds : 0);
  result.likeness = 1 / (1 + std::exp(-logit));
  return result;
}

}  // namespace skel
