#include "trainer/optimizer.h"

#include "libskel/core/check.h"

namespace skel {

std::unique_ptr<Optimizer> makeOptimizer(TrainingMethod method, const TrainingData& data,
                                         const std::vector<int>& sizes, const OptimizerOptions& options) {
  SKEL_CHECK_EQ(data.samples.inputs.cols(), sizes.front());
  SKEL_CHECK_EQ(data.samples.targets.cols(), sizes.back());
  switch (method) {
    case TrainingMethod::kGradient:
      return makeGradientDescent(data, sizes, options);
    case TrainingMethod::kRprop:
      return makeRprop(data, sizes, options);
    case TrainingMethod::kLbfgs:
      return makeLbfgs(data, sizes, options);
  }
  SKEL_CHECK(false);
  return nullptr;
}

Eigen::VectorXf decayOf(const std::vector<int>& sizes, double weight_decay) {
  Network<float> network(sizes);
  for (int l = 0; l < network.layerCount(); ++l)
    network.weights(l).setConstant(static_cast<float>(weight_decay));
  return network.parameters;
}

}  // namespace skel
