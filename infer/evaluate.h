// skel-infer evaluate: joints and silhouettes against annotated drawings.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "infer/infer_options.h"

namespace skel {

struct EvaluateOptions {
  std::string dir;
  std::string json_file;
  std::string overlays;  // folder for pictures of the skeletons found; "": none
  bool given_mask = false, opaque = false;
  int turn_deg = 0;    // clockwise
  InferOptions infer;  // weights, template, recognizer, candidates, jobs
};

void bindEvaluateOptions(CLI::App& app, EvaluateOptions& options);
ExitCode runEvaluate(const EvaluateOptions& options);

}  // namespace skel
