#include "libskel/style/smooth_series.h"

#include <Eigen/SparseCholesky>
#include <vector>

#include "libskel/core/check.h"

namespace skel {

Eigen::MatrixXd smoothSeries(const Eigen::MatrixXd& y, const Eigen::VectorXd& weights, double strength,
                             bool loop) {
  SKEL_CHECK_EQ(y.rows(), weights.size());
  const int m = int(y.rows());
  // A trace of weight everywhere and of a pull to the straight line keep the matrix regular where little is
  // known.
  constexpr double kTrace = 1e-9;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < m; ++i) entries.emplace_back(i, i, weights(i) + kTrace);
  const bool around = loop && m > 3;
  for (int i = around ? 0 : 1; i + (around ? 0 : 1) < m; ++i) {
    const int at[] = {(i + m - 1) % m, i, (i + 1) % m};
    const double share[] = {1, -2, 1};
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) entries.emplace_back(at[a], at[b], strength * share[a] * share[b]);
  }
  Eigen::SparseMatrix<double> matrix(m, m);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  return solver.solve(weights.asDiagonal() * y);
}

}  // namespace skel
