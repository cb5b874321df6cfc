// The commands `skel-train DIR -o FILE` and `skel-train evaluate DIR`.
#pragma once

#include <string>

#include "libskel/candidates/candidates.h"
#include "libskel/core/error.h"
#include "trainer/training.h"

namespace CLI {
class App;
}

namespace skel {

struct TrainOptions {
  std::string dir, output, json, report;
  std::string layers = "3-4-4-2";
  std::string class_weights = "none";
  CandidateMethod candidates = CandidateMethod::kMaxima;
  TrainingOptions training;
  int folds = 10;  // 0: no cross-validation
  bool leave_one_out = false, no_mirror = false;
  int generated = 1000;  // figures
  int draws = 0;         // of the paper's protocol
  int drawn = 17;
};
void bindTrainOptions(CLI::App& app, TrainOptions& options);
ExitCode runTrain(const TrainOptions& options);

struct EvaluateWeightsOptions {
  std::string dir, weights, json;
  CandidateMethod candidates = CandidateMethod::kMaxima;
};
void bindEvaluateWeightsOptions(CLI::App& app, EvaluateWeightsOptions& options);
ExitCode runEvaluateWeights(const EvaluateWeightsOptions& options);

}  // namespace skel
