#include "trainer/logistic_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "libskel/core/check.h"
#include "libskel/core/rng.h"

namespace skel {
namespace {

// All numbers of a net in a row: direct, hidden row by row, hidden_bias, out, bias.
struct Parameters {
  Eigen::Index inputs, hidden;
  Eigen::VectorXd values;

  Parameters(Eigen::Index n, Eigen::Index h)
      : inputs(n), hidden(h), values(Eigen::VectorXd::Zero(n + h * n + h + h + 1)) {}
  auto direct() { return values.head(inputs); }
  auto rows() { return values.segment(inputs, hidden * inputs).reshaped<Eigen::RowMajor>(hidden, inputs); }
  auto hiddenBias() { return values.segment(inputs + hidden * inputs, hidden); }
  auto out() { return values.segment(inputs + hidden * inputs + hidden, hidden); }
  double& bias() { return values[values.size() - 1]; }
};

}  // namespace

LogisticNet fitLogisticNet(const Eigen::MatrixXd& inputs, const Eigen::VectorXd& came_true,
                           const Eigen::VectorXd& weights, const LogisticFitOptions& options) {
  constexpr double kFirst = .9, kSecond = .999, kLeast = 1e-8;  // Kingma & Ba, "Adam" (2014)
  const Eigen::Index count = inputs.rows(), n = inputs.cols(), h = options.hidden;
  SKEL_CHECK(count > 0 && came_true.size() == count && weights.size() == count);
  LogisticNet net;
  const double sum = weights.sum();
  net.mean = inputs.transpose() * weights / sum;
  const Eigen::MatrixXd centred = inputs.rowwise() - net.mean.transpose();
  net.deviation = (centred.array().square().matrix().transpose() * weights / sum).array().sqrt();
  // What is always the same says nothing.
  net.deviation = (net.deviation.array() < 1e-6).select(1., net.deviation);
  Eigen::MatrixXd x(count, n);
  for (Eigen::Index i = 0; i < count; ++i) x.row(i) = net.standardized(inputs.row(i).transpose()).transpose();

  Rng rng(options.seed);
  Parameters p(n, h), gradient(n, h);
  for (double& w : p.rows().reshaped()) w = rng.normal() / std::sqrt(static_cast<double>(n));
  for (double& w : p.out().reshaped()) w = .1 * rng.normal();
  Eigen::VectorXd first = Eigen::VectorXd::Zero(p.values.size()), second = first;
  Eigen::VectorXd decayed = Eigen::VectorXd::Ones(p.values.size());
  decayed.segment(n + h * n, h).setZero();
  decayed[decayed.size() - 1] = 0;

  std::vector<Eigen::Index> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  const double mean_weight = sum / static_cast<double>(count);
  Eigen::Index from = count;
  for (int step = 1; step <= options.steps; ++step, from += options.batch) {
    if (from >= count) {
      for (std::size_t i = order.size(); i > 1; --i)
        std::swap(order[i - 1], order[rng.below(static_cast<std::uint32_t>(i))]);
      from = 0;
    }
    const Eigen::Index size = std::min<Eigen::Index>(options.batch, count - from);
    gradient.values = options.decay * 2 * p.values.cwiseProduct(decayed);
    for (Eigen::Index k = from; k < from + size; ++k) {
      const Eigen::Index i = order[static_cast<std::size_t>(k)];
      const Eigen::VectorXd row = x.row(i).transpose();
      const Eigen::VectorXd units = (p.rows() * row + p.hiddenBias()).array().tanh();
      const double log_odds = p.bias() + p.direct().dot(row) + p.out().dot(units);
      const double slope = (1 / (1 + std::exp(-log_odds)) - came_true[i]) * weights[i] /
                           (mean_weight * static_cast<double>(size));
      const Eigen::VectorXd back = slope * (p.out().array() * (1 - units.array().square())).matrix();
      gradient.direct() += slope * row;
      gradient.rows() += back * row.transpose();
      gradient.hiddenBias() += back;
      gradient.out() += slope * units;
      gradient.bias() += slope;
    }
    first = kFirst * first + (1 - kFirst) * gradient.values;
    second = kSecond * second + (1 - kSecond) * gradient.values.cwiseAbs2();
    const double rate = options.rate * (1 + std::cos(std::numbers::pi * step / options.steps)) / 2;
    const Eigen::ArrayXd mean = first.array() / (1 - std::pow(kFirst, step)),
                         square = second.array() / (1 - std::pow(kSecond, step));
    p.values.array() -= rate * mean / (square.sqrt() + kLeast);
  }
  net.direct = p.direct();
  net.hidden = p.rows();
  net.hidden_bias = p.hiddenBias();
  net.out = p.out();
  net.bias = p.bias();
  return net;
}

}  // namespace skel
