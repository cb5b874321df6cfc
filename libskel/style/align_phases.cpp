#include "libskel/style/align_phases.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/style/smooth_series.h"

namespace skel {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// For a step that differs from the mean speed by as much as it is: so much of a squared difference of poses.
constexpr double kUnevenStep = 0.05;
constexpr double kSmoothing = 2;
// Frames of the one times those of the other; times the steps that each may take on a circle.
constexpr Index kMostPairs = 16'000'000, kMostSteps = 100'000'000;

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

// Frames after which the content, having changed, looks as before: its number of frames if it shows one
// cycle.
double period(const MatrixXd& content, bool loops) {
  const Index n = content.cols(), shortest = 4, longest = 1000;
  const double spread = 2;  // of two frames that have nothing in common
  bool changed = false;
  for (Index lag = 1; lag <= std::min(n / 2, longest); ++lag) {
    double sum = 0;
    int count = 0;
    for (Index i = 0; i < n; ++i) {
      if (!loops && i + lag >= n) break;
      sum += (content.col((i + lag) % n) - content.col(i)).squaredNorm();
      ++count;
    }
    const bool alike = sum / count < 0.15 * spread;
    if (alike && changed && lag >= shortest) return double(lag);
    changed = changed || !alike;
  }
  return double(n);
}

// So many style frames a content frame goes on by at most.
Index largestStep(double speed) { return Index(std::ceil(2 * speed)) + 1; }

// The step's cost and the step, where it costs less than those before.
void keepLess(double* __restrict sum, double* __restrict steps, const double* __restrict before,
              const double* __restrict here, double pace, double step, Index count) {
  for (Index j = 0; j < count; ++j) {
    const double cost = before[j] + pace + here[j];
    steps[j] = cost < sum[j] ? step : steps[j];
    sum[j] = cost < sum[j] ? cost : sum[j];
  }
}

// On a circle: each content frame goes on by 0 or more style frames. A content that loops comes back to where
// it began. d: m×n, of style frames and content frames.
Warp circularWarp(const MatrixXd& d, double speed, bool closes, const std::function<void()>& on_beginning) {
  const Index n = d.cols(), m = d.rows();
  const Index largest = largestStep(speed);
  const auto stepCost = [&](Index step) {
    return kUnevenStep * std::pow((double(step) - speed) / std::max(speed, 0.5), 2);
  };
  Warp best;
  const Index beginnings = closes ? std::min(m, Index(kPhaseBeginnings)) : 1;
  Eigen::ArrayXXi step(m, n);
  ArrayXd sum(m), before(m);
  for (Index s = 0; s < beginnings; ++s) {
    const Index start = s * m / beginnings;
    if (closes) {
      sum.setConstant(kInfinity);
      sum(start) = d(start, 0);
    } else {
      sum = d.col(0);
    }
    for (Index i = 1; i < n; ++i) {
      std::swap(sum, before);
      sum.setConstant(kInfinity);
      const double* const here = d.col(i).data();
      ArrayXd steps = ArrayXd::Zero(m);
      for (Index k = 0; k <= largest && k < m; ++k) {
        const double pace = stepCost(k);
        // From frames j - k: before the end, and round it.
        keepLess(sum.data() + k, steps.data() + k, before.data(), here + k, pace, double(k), m - k);
        keepLess(sum.data(), steps.data(), before.data() + m - k, here, pace, double(k), k);
      }
      step.col(i) = steps.cast<int>();
    }
    if (closes)
      for (Index end = 0; end < m; ++end) {
        const Index left = (start - end + m) % m;
        sum(end) += left <= largest ? stepCost(left) : kInfinity;
      }
    if (on_beginning) on_beginning();
    Index j;
    const double cost = sum.minCoeff(&j) / double(n);
    if (!(cost < best.cost)) continue;
    best.cost = cost;
    best.frames.assign(std::size_t(n), 0);
    for (Index i = n - 1; i > 0; --i) {
      best.frames[std::size_t(i)] = step(j, i);
      j = (j - step(j, i) + m) % m;
    }
    best.frames[0] = double(j);
    std::partial_sum(best.frames.begin(), best.frames.end(), best.frames.begin());
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
  const Index n = content.cols(), m = style.cols();
  const auto refuse = [&](const std::string& both) {
    throw InputError(options.content_path, "has " + std::to_string(n) + " frames and " + options.style_path +
                                               " has " + std::to_string(m) + ": " + both);
  };
  if (n * m > kMostPairs) refuse("one times the other are 16 million at most; cut them, or one of them");
  const MatrixXd a = spreadOut(content), b = spreadOut(style);
  Warp warp;
  if (options.style_loops && n > 1) {
    const double cycle = period(a, options.content_loops);
    const double pace = options.content_loops
                            ? std::max(1., std::round(double(n) / cycle)) * double(m) / double(n)
                            : double(m) / cycle;
    if (n * m * std::min(largestStep(pace) + 1, m) > kMostSteps)
      refuse("all of these would pass in " + std::to_string(int(std::lround(double(m) / pace))) +
             " of the content's, too many to choose from; cut the style to one cycle, or give --loop no");
    const MatrixXd d = squaredDifferences(b, a);
    warp = circularWarp(d, pace, options.content_loops, options.on_beginning);
    if (warp.frames.empty()) warp = circularWarp(d, pace, false, options.on_beginning);
    // What a loop really goes round.
    const double turns = std::round((warp.frames.back() - warp.frames.front() + pace) / double(m));
    smoothFrames(warp.frames, options.content_loops ? turns * double(m) / double(n) : pace,
                 options.content_loops);
  } else {
    warp = straightWarp(squaredDifferences(a, b));
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
