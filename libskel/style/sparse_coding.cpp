#include "libskel/style/sparse_coding.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/core/rng.h"

namespace skel {
namespace {

using Eigen::MatrixXd;

constexpr double kSmallestStep = 1e-12;
constexpr double kLargestStep = 1e6;
constexpr int kQuietIterations = 20;

void check(const MatrixXd& data, const SparseCodingOptions& options) {
  if (data.size() == 0) throw UsageError("there are no poses to factorise");
  if (!data.allFinite()) throw UsageError("the poses to factorise hold what is no number");
  if (data.minCoeff() < 0) throw UsageError("the poses to factorise hold a negative number");
  if (options.components < 1)
    throw UsageError("a factorisation has at least one component, not " + std::to_string(options.components));
  if (!(options.sparsity >= 0)) throw UsageError("the sparsity of a factorisation is not negative");
}

// One step for V; what is divided by nothing has nothing to gain.
MatrixXd updated(const MatrixXd& v, const MatrixXd& ut_x, const MatrixXd& ut_u, double sparsity) {
  const MatrixXd below = (ut_u * v).array() + sparsity;
  return (below.array() > 0).select(v.array() * ut_x.array() / below.array(), v.array());
}

// The objective in terms of products that are small: no n×m matrix is made.
struct Products {
  double x2;       // ‖X‖²
  MatrixXd x_vt;   // n×k
  MatrixXd v_vt;   // k×k
  double penalty;  // α ΣV

  double objective(const MatrixXd& u) const {
    return 0.5 * x2 - u.cwiseProduct(x_vt).sum() + 0.5 * (u.transpose() * u).cwiseProduct(v_vt).sum() +
           penalty;
  }
};

bool normalizeColumns(MatrixXd& u) {
  for (Eigen::Index c = 0; c < u.cols(); ++c) {
    const double length = u.col(c).norm();
    if (!(length > 1e-12)) return false;
    u.col(c) /= length;
  }
  return true;
}

class Run {
 public:
  Run(const MatrixXd& data, const SparseCodingOptions& options, std::uint64_t stream)
      : x_(data), options_(options), x2_(data.squaredNorm()) {
    const int k = options.components;
    // A start that is near the data's mean, and that knows nothing of the order of the columns.
    const Eigen::VectorXd mean = data.rowwise().mean();
    const double level = std::max(mean.mean(), 1e-3);
    Rng rng(options.seed, stream);
    u_.resize(data.rows(), k);
    for (Eigen::Index c = 0; c < k; ++c)
      for (Eigen::Index r = 0; r < data.rows(); ++r)
        u_(r, c) = (0.5 * mean(r) + level) * (0.05 + rng.uniform());
    normalizeColumns(u_);
    v_ = (u_.transpose() * data) / double(k);
    v_ = v_.cwiseMax(1e-9);
  }

  SparseCoding operator()() {
    SparseCoding result;
    double now = products().objective(u_);
    result.objectives.push_back(now);
    int quiet = 0;
    for (int i = 0; i < options_.max_iterations; ++i) {
      const double before = now;
      now = stepBasis(products(), now);
      MatrixXd v = updated(v_, u_.transpose() * x_, u_.transpose() * u_, options_.sparsity);
      std::swap(v, v_);
      // The update lowers the objective (Hoyer 2002, theorem 1); what raises it are rounding errors at its
      // end.
      if (const double objective = products().objective(u_); objective <= now)
        now = objective;
      else
        std::swap(v, v_);
      result.objectives.push_back(now);
      if (options_.on_iteration) options_.on_iteration();
      // One small step may be that of a column that shrank to nothing on the way; many are the end.
      quiet = before - now <= options_.tolerance * std::max(std::abs(now), 1e-12 * x2_) ? quiet + 1 : 0;
      if (quiet == kQuietIterations) break;
    }
    sortComponents();
    result.error = x2_ > 0 ? (x_ - u_ * v_).norm() / std::sqrt(x2_) : 0;
    result.basis = std::move(u_);
    result.activations = std::move(v_);
    return result;
  }

 private:
  Products products() const {
    return {x2_, x_ * v_.transpose(), v_ * v_.transpose(), options_.sparsity * v_.sum()};
  }

  // Projected gradient with a step that is halved until the objective does not rise. Returns the objective.
  double stepBasis(const Products& p, double now) {
    const MatrixXd gradient = u_ * p.v_vt - p.x_vt;
    for (; step_ > kSmallestStep; step_ /= 2) {
      MatrixXd tried = (u_ - step_ * gradient).cwiseMax(0);
      if (!normalizeColumns(tried)) continue;
      const double objective = p.objective(tried);
      if (objective > now) continue;
      u_ = std::move(tried);
      step_ = std::min(2 * step_, kLargestStep);
      return objective;
    }
    step_ = 1;
    return now;
  }

  void sortComponents() {
    const Eigen::VectorXd share = v_.rowwise().sum();
    std::vector<int> order(std::size_t(v_.rows()));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return share(a) > share(b); });
    const MatrixXd u = u_, v = v_;
    for (Eigen::Index c = 0; c < u.cols(); ++c) {
      u_.col(c) = u.col(order[std::size_t(c)]);
      v_.row(c) = v.row(order[std::size_t(c)]);
    }
  }

  const MatrixXd& x_;
  const SparseCodingOptions& options_;
  double x2_;
  MatrixXd u_, v_;
  double step_ = 1;
};

}  // namespace

SparseCoding sparseCoding(const MatrixXd& data, const SparseCodingOptions& options) {
  check(data, options);
  SparseCoding best;
  for (int i = 0; i < std::max(1, options.restarts); ++i) {
    SparseCoding run = Run(data, options, std::uint64_t(i))();
    if (best.objectives.empty() || run.objectives.back() < best.objectives.back()) best = std::move(run);
  }
  return best;
}

MatrixXd activationsFor(const MatrixXd& data, const MatrixXd& basis, double sparsity, int iterations,
                        MatrixXd start) {
  SKEL_CHECK_EQ(data.rows(), basis.rows());
  const MatrixXd ut_x = basis.transpose() * data, ut_u = basis.transpose() * basis;
  MatrixXd v = start.size() > 0 ? std::move(start) : MatrixXd(ut_x / double(basis.cols()));
  for (int i = 0; i < iterations; ++i) v = updated(v, ut_x, ut_u, sparsity);
  return v;
}

}  // namespace skel
