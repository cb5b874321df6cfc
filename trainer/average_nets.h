// skel-train average: the mean of the weights of several passes of one training.
//
// Nets that were trained on from one another lie in one valley of the loss; their mean generalises better
// than the last one (M. Wortsman et al., "Model soups: averaging weights of multiple fine-tuned models
// improves accuracy without increasing inference time", 2022).
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "libskel/core/error.h"

namespace skel {

struct AverageNetsOptions {
  std::vector<std::string> nets;  // files of joint nets, or of part nets
  std::string output = "out/joint_net.bin";
};

void bindAverageNetsOptions(CLI::App& command, AverageNetsOptions& options);
ExitCode runAverageNets(const AverageNetsOptions& options);

}  // namespace skel
