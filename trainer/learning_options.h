// What all who learn from drawings of several hands ask for.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace skel {

struct LearningOptions {
  std::string hands;  // file, see readHands()
  int folds = 5;
  int seed = 1;
  int threads = 0;
};

// --hands, --folds, --seed, --threads.
void bindLearningOptions(CLI::App& command, LearningOptions& options);

}  // namespace skel
