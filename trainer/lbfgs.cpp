#include <deque>

#include "trainer/optimizer.h"

namespace skel {
namespace {

constexpr std::size_t kMemory = 12;
constexpr int kMaxHalvings = 20;
constexpr double kEnoughDecrease = 1e-4;

class Lbfgs : public Optimizer {
 public:
  Lbfgs(const TrainingData& data, const std::vector<int>& sizes, const OptimizerOptions& options)
      : data_(data), backprop_(sizes), decay_(decayOf(sizes, options.weight_decay)), trial_(sizes) {
    gradient_.setZero(decay_.size());
    trial_gradient_.setZero(decay_.size());
  }

  double pass(Network<float>& network) override {
    if (!started_) {
      loss_ = evaluate(network, gradient_, data_loss_);
      started_ = true;
    }
    const double before = data_loss_;
    Eigen::VectorXf direction = -quasiNewton(gradient_);
    double slope = direction.dot(gradient_);
    if (!(slope < 0)) {
      history_.clear();
      direction = -gradient_;
      slope = direction.dot(gradient_);
    }
    float length = history_.empty() ? 1 / std::max(1.f, gradient_.norm()) : 1.f;
    for (int halvings = 0; halvings < kMaxHalvings; ++halvings, length /= 2) {
      trial_.parameters = network.parameters + length * direction;
      limitParameters(trial_.parameters);
      double trial_data_loss;
      const double trial_loss = evaluate(trial_, trial_gradient_, trial_data_loss);
      if (trial_loss > loss_ + kEnoughDecrease * length * slope) continue;
      remember(trial_.parameters - network.parameters, trial_gradient_ - gradient_);
      network.parameters = trial_.parameters;
      gradient_.swap(trial_gradient_);
      loss_ = trial_loss;
      data_loss_ = trial_data_loss;
      return before;
    }
    history_.clear();  // Curvature that leads nowhere: begin anew along the gradient.
    return before;
  }

 private:
  struct Step {
    Eigen::VectorXf move, change;  // of the parameters, of the gradient
    float inverse;                 // 1 / (move · change)
  };

  double evaluate(const Network<float>& network, Eigen::VectorXf& gradient, double& data_loss) {
    data_loss = backprop_.lossAndGradient(network, data_.blocks, gradient);
    gradient += 2 * decay_.cwiseProduct(network.parameters);
    return data_loss + static_cast<double>(decay_.dot(network.parameters.cwiseAbs2()));
  }

  // The inverse of the loss's curvature, times v (algorithm 7.4).
  Eigen::VectorXf quasiNewton(Eigen::VectorXf v) const {
    std::vector<float> factors;
    for (auto step = history_.rbegin(); step != history_.rend(); ++step) {
      factors.push_back(step->inverse * step->move.dot(v));
      v -= factors.back() * step->change;
    }
    if (!history_.empty()) v /= history_.back().inverse * history_.back().change.squaredNorm();
    for (const Step& step : history_) {
      v += (factors.back() - step.inverse * step.change.dot(v)) * step.move;
      factors.pop_back();
    }
    return v;
  }

  void remember(const Eigen::VectorXf& move, const Eigen::VectorXf& change) {
    const float curvature = move.dot(change);
    if (!(curvature > 1e-7f * move.norm() * change.norm())) return;
    history_.push_back({move, change, 1 / curvature});
    if (history_.size() > kMemory) history_.pop_front();
  }

  const TrainingData& data_;
  Backprop<float> backprop_;
  Eigen::VectorXf decay_, gradient_, trial_gradient_;
  Network<float> trial_;
  std::deque<Step> history_;
  double loss_ = 0, data_loss_ = 0;
  bool started_ = false;
};

}  // namespace

std::unique_ptr<Optimizer> makeLbfgs(const TrainingData& data, const std::vector<int>& sizes,
                                     const OptimizerOptions& options) {
  return std::make_unique<Lbfgs>(data, sizes, options);
}

}  // namespace skel
