#include "libskel/style/align_phases.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libskel/core/check.h"
#include "libskel/style/smooth_series.h"

namespace skel {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// For a step that differs from the mean speed by as much as it is: so much of a squared difference of poses.
constexpr double kUnevenStep = 0.05;
// On a circle, beginnings are tried so many at most.
constexpr Index kBeginnings = 60;
constexpr double kSmoothing = 2;

MatrixXd spreadOut(const PoseMatrix& poses) {
  MatrixXd centred = poses.colwise() - poses.rowwise().mean();
  const double spread = std::sqrt(centred.squaredNorm() / double(centred.cols()));
  return spread > 1e-9 ? MatrixXd(centred / spread) : centred;
}

MatrixXd squaredDifferences(const MatrixXd& a, const MatrixXd& b) {
  return ((-2 * a.transpose() * b).colwise() + a.colwise().squaredNorm().transpose()).rowwise() +
         b.colwise().squaredNorm();
}

struct Warp {
  std::vector<double> frames;  // counted on beyond the end, where the style loops
  double cost = kInfinity;
};

// From corner to corner; a content frame that meets several style frames takes their middle.
Warp straightWarp(const MatrixXd& d) {
  const Index n = d.rows(), m = d.cols();
  MatrixXd sum = MatrixXd::Constant(n, m, kInfinity);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < m; ++j) {
      double before = i == 0 && j == 0 ? 0 : kInfinity;
      if (i > 0 && j > 0) before = std::min(before, sum(i - 1, j - 1));
      if (i > 0) before = std::min(before, sum(i - 1, j));
      if (j > 0) before = std::min(before, sum(i, j - 1));
      sum(i, j) = before + d(i, j);
    }
  std::vector<double> total(std::size_t(n), 0);
  std::vector<int> count(std::size_t(n), 0);
  double cost = 0;
  int steps = 0;
  for (Index i = n - 1, j = m - 1;; ++steps) {
    total[std::size_t(i)] += double(j);
    ++count[std::size_t(i)];
    cost += d(i, j);
    if (i == 0 && j == 0) break;
    const double diagonal = i > 0 && j > 0 ? sum(i - 1, j - 1) : kInfinity;
    const double up = i > 0 ? sum(i - 1, j) : kInfinity, left = j > 0 ? sum(i, j - 1) : kInfinity;
    if (diagonal <= up && diagonal <= left)
      --i, --j;
    else if (up <= left)
      --i;
    else
      --j;
  }
  Warp warp;
  for (std::size_t i = 0; i < std::size_t(n); ++i) warp.frames.push_back(total[i] / count[i]);
  warp.cost = cost / (steps + 1);
  return warp;
}

// Frames after which the content looks most as before: its number of frames if it shows one cycle.
double period(const MatrixXd& content, bool loops) {
  const Index n = content.cols();
  const double spread = 2;  // of two frames that have nothing in common
  for (Index lag = 4; lag <= n / 2; ++lag) {
    double sum = 0;
    int count = 0;
    for (Index i = 0; i < n; ++i) {
      if (!loops && i + lag >= n) break;
      sum += (content.col((i + lag) % n) - content.col(i)).squaredNorm();
      ++count;
    }
    if (sum / count < 0.15 * spread) return double(lag);
  }
  return double(n);
}

// On a circle: each content frame goes on by 0 or more style frames. A content that loops comes back to where
// it began.
Warp circularWarp(const MatrixXd& d, double speed, bool closes) {
  const Index n = d.rows(), m = d.cols();
  const int largest = int(std::ceil(2 * speed)) + 1;
  const auto stepCost = [&](int step) {
    return kUnevenStep * std::pow((step - speed) / std::max(speed, 0.5), 2);
  };
  Warp best;
  const Index beginnings = closes ? std::min(m, kBeginnings) : 1;
  for (Index s = 0; s < beginnings; ++s) {
    const Index start = s * m / beginnings;
    std::vector<std::vector<double>> sum(std::size_t(n), std::vector<double>(std::size_t(m), kInfinity));
    std::vector<std::vector<int>> step(std::size_t(n), std::vector<int>(std::size_t(m), 0));
    if (closes)
      sum[0][std::size_t(start)] = d(0, start);
    else
      for (Index j = 0; j < m; ++j) sum[0][std::size_t(j)] = d(0, j);
    for (std::size_t i = 1; i < std::size_t(n); ++i)
      for (Index j = 0; j < m; ++j)
        for (int k = 0; k <= largest && k < m; ++k) {
          const double cost = sum[i - 1][std::size_t((j - k + m) % m)] + stepCost(k) + d(Index(i), j);
          if (cost < sum[i][std::size_t(j)]) sum[i][std::size_t(j)] = cost, step[i][std::size_t(j)] = k;
        }
    for (Index end = 0; end < m; ++end) {
      double cost = sum.back()[std::size_t(end)];
      if (closes) {
        const Index left = (start - end + m) % m;
        cost += left <= largest ? stepCost(int(left)) : kInfinity;
      }
      if (!(cost / double(n) < best.cost)) continue;
      best.cost = cost / double(n);
      std::vector<int> steps(static_cast<std::size_t>(n));
      Index j = end;
      for (std::size_t i = std::size_t(n) - 1; i > 0; --i) {
        steps[i] = step[i][std::size_t(j)];
        j = (j - steps[i] + m) % m;
      }
      best.frames.assign(1, double(j));
      for (std::size_t i = 1; i < std::size_t(n); ++i) best.frames.push_back(best.frames.back() + steps[i]);
    }
  }
  return best;
}

// What is left of the whole steps, taken out: first of what lies beside an even pace, so that a loop closes.
void smoothFrames(std::vector<double>& frames, double pace, bool loops) {
  const Index n = Index(frames.size());
  if (n < 4) return;
  MatrixXd rest(n, 1);
  for (Index i = 0; i < n; ++i) rest(i, 0) = frames[std::size_t(i)] - pace * double(i);
  rest = smoothSeries(rest, Eigen::VectorXd::Ones(n), kSmoothing, loops);
  for (Index i = 0; i < n; ++i) frames[std::size_t(i)] = rest(i, 0) + pace * double(i);
}

}  // namespace

PhaseAlignment alignPhases(const PoseMatrix& content, const PoseMatrix& style, const PhaseOptions& options) {
  SKEL_CHECK_EQ(content.rows(), style.rows());
  SKEL_CHECK(content.cols() > 0 && style.cols() > 0);
  const MatrixXd a = spreadOut(content), b = spreadOut(style);
  const MatrixXd d = squaredDifferences(a, b);
  const Index n = a.cols(), m = b.cols();
  Warp warp;
  if (options.style_loops && n > 1) {
    const double cycles = std::max(1., std::round(double(n) / period(a, options.content_loops)));
    const double pace =
        options.content_loops ? cycles * double(m) / double(n) : double(m) / period(a, options.content_loops);
    warp = circularWarp(d, pace, options.content_loops);
    if (warp.frames.empty()) warp = circularWarp(d, pace, false);
    // What a loop really goes round.
    const double turns = std::round((warp.frames.back() - warp.frames.front() + pace) / double(m));
    smoothFrames(warp.frames, options.content_loops ? turns * double(m) / double(n) : pace,
                 options.content_loops);
  } else {
    warp = straightWarp(d);
    smoothFrames(warp.frames, double(m) / double(n), false);
    for (double& frame : warp.frames) frame = std::clamp(frame, 0., double(m - 1));
  }
  PhaseAlignment result;
  result.cost = warp.cost;
  for (const double frame : warp.frames) {
    double within = std::fmod(frame, double(m));
    if (within < 0) within += double(m);
    result.style_frame.push_back(within < double(m) ? within : 0);
  }
  return result;
}

PoseMatrix posesAt(const PoseMatrix& poses, const std::vector<double>& frames, bool loops) {
  const Index m = poses.cols();
  PoseMatrix result(poses.rows(), Index(frames.size()));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Index before = std::clamp(Index(std::floor(frames[i])), Index(0), m - 1);
    const Index after = before + 1 < m ? before + 1 : loops ? 0 : m - 1;
    const double t = std::clamp(frames[i] - double(before), 0., 1.);
    result.col(Index(i)) = (1 - t) * poses.col(before) + t * poses.col(after);
  }
  return result;
}

}  // namespace skel
