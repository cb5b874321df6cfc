// skel-train facing: learns which way two-legged figures look.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "libskel/core/error.h"
#include "trainer/learning_options.h"

namespace skel {

struct FacingTrainingOptions : LearningOptions {
  std::vector<std::string> drawings;  // folders, see findJointedDrawings()
  std::string output = "out/facing_net.json";
};

void bindFacingTrainingOptions(CLI::App& command, FacingTrainingOptions& options);
ExitCode runFacingTraining(const FacingTrainingOptions& options);

}  // namespace skel
