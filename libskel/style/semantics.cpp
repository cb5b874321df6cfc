#include "libskel/style/semantics.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "libskel/core/check.h"
#include "libskel/core/error.h"

namespace skel {
namespace {

using Eigen::MatrixXd;

// The r leading eigenvectors of V·Vᵀ, each turned so that the activations lie on its positive side, and the
// weights >= 0 that rebuild V best from them: as they are orthonormal, those are max(0, EᵀV).
MatrixXd rebuiltFromLeading(const MatrixXd& v, int count) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(v * v.transpose());
  MatrixXd leading = solver.eigenvectors().rightCols(count);
  for (int c = 0; c < count; ++c) {
    const Eigen::RowVectorXd weights = leading.col(c).transpose() * v;
    if (weights.cwiseMax(0).squaredNorm() < weights.cwiseMin(0).squaredNorm()) leading.col(c) *= -1;
  }
  return leading * (leading.transpose() * v).cwiseMax(0);
}

}  // namespace

Semantics fitSemantics(const MatrixXd& activations, const std::vector<std::string>& actions,
                       const SemanticOptions& options) {
  SKEL_CHECK_EQ(std::size_t(activations.cols()), actions.size());
  if (actions.empty() || activations.rows() == 0) throw UsageError("there are no frames to classify");
  Semantics result;
  result.classes = actions;
  std::sort(result.classes.begin(), result.classes.end());
  result.classes.erase(std::unique(result.classes.begin(), result.classes.end()), result.classes.end());
  if (result.classes.front().empty()) throw UsageError("a frame to classify has no action class");

  const Eigen::Index k = activations.rows(), m = activations.cols();
  const Eigen::Index r = Eigen::Index(result.classes.size());
  std::vector<int> truth;
  for (const std::string& action : actions)
    truth.push_back(
        int(std::lower_bound(result.classes.begin(), result.classes.end(), action) - result.classes.begin()));

  result.rebuilt = rebuiltFromLeading(activations, int(std::min(r, k)));
  const MatrixXd& v = result.rebuilt;
  const double ridge = options.ridge * std::max(v.squaredNorm() / double(k), 1e-12);
  const MatrixXd normal = v * v.transpose() + ridge * MatrixXd::Identity(k, k);
  // Y, one row a class and one column a frame, is 1 at each frame's class: never held, it may be huge.
  MatrixXd sums = MatrixXd::Zero(k, r);  // V·Yᵀ
  for (Eigen::Index i = 0; i < m; ++i) sums.col(truth[std::size_t(i)]) += v.col(i);
  result.class_weights = normal.ldlt().solve(sums).transpose();
  int right = 0;
  for (Eigen::Index i = 0; i < m; ++i) {
    const int true_class = truth[std::size_t(i)];
    Eigen::VectorXd scores = result.class_weights * v.col(i);
    Eigen::Index best;
    scores.maxCoeff(&best);
    result.predicted.push_back(int(best));
    right += int(best) == true_class;
    scores[true_class] -= 1;
    result.residual += scores.squaredNorm();
  }
  result.accuracy = double(right) / double(m);
  return result;
}

std::vector<int> matchSignatures(const MatrixXd& ours, const MatrixXd& theirs) {
  SKEL_CHECK_EQ(ours.rows(), theirs.rows());
  SKEL_CHECK_EQ(ours.cols(), theirs.cols());
  // Kuhn's method with potentials (Jonker, Volgenant 1987): one shortest augmenting path a row. Row and
  // column 0 stand for none.
  const int n = int(ours.cols());
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::vector<double> of_row(std::size_t(n) + 1), of_column(std::size_t(n) + 1);
  std::vector<int> row_of(std::size_t(n) + 1), way(std::size_t(n) + 1);
  for (int i = 1; i <= n; ++i) {
    std::vector<double> least(std::size_t(n) + 1, kFar);
    std::vector<bool> used(std::size_t(n) + 1, false);
    row_of[0] = i;
    int column = 0;
    do {
      used[std::size_t(column)] = true;
      const int row = row_of[std::size_t(column)];
      int next = 0;
      double step = kFar;
      for (int c = 1; c <= n; ++c) {
        if (used[std::size_t(c)]) continue;
        const double cost = (ours.col(row - 1) - theirs.col(c - 1)).squaredNorm() - of_row[std::size_t(row)] -
                            of_column[std::size_t(c)];
        if (cost < least[std::size_t(c)]) least[std::size_t(c)] = cost, way[std::size_t(c)] = column;
        if (least[std::size_t(c)] < step) step = least[std::size_t(c)], next = c;
      }
      for (int c = 0; c <= n; ++c) {
        if (used[std::size_t(c)]) {
          of_row[std::size_t(row_of[std::size_t(c)])] += step;
          of_column[std::size_t(c)] -= step;
        } else {
          least[std::size_t(c)] -= step;
        }
      }
      column = next;
    } while (row_of[std::size_t(column)] != 0);
    for (; column != 0; column = way[std::size_t(column)])
      row_of[std::size_t(column)] = row_of[std::size_t(way[std::size_t(column)])];
  }
  std::vector<int> match(static_cast<std::size_t>(n));
  for (int c = 1; c <= n; ++c) match[std::size_t(row_of[std::size_t(c)] - 1)] = c - 1;
  return match;
}

}  // namespace skel
