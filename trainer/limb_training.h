// skel-train limbs: learns whether what was found of a limb is one.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "libskel/core/error.h"
#include "trainer/learning_options.h"

namespace skel {

struct LimbTrainingOptions : LearningOptions {
  std::vector<std::string> drawings;  // folders, see findJointedDrawings()
  std::string shapes, first_hand;
  std::string output = "out/limb_net.json";
};

void bindLimbTrainingOptions(CLI::App& command, LimbTrainingOptions& options);
ExitCode runLimbTraining(const LimbTrainingOptions& options);

}  // namespace skel
