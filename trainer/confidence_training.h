// skel-train confidence: learns how sure the recognition may be of what it finds.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "libskel/core/error.h"
#include "trainer/learning_options.h"

namespace skel {

struct ConfidenceTrainingOptions : LearningOptions {
  std::map<std::string, std::vector<std::string>>
      drawings;  // by body plan: folders, see findJointedDrawings()
  std::vector<std::string> tables;
  std::string first_hand;
  std::string output, table;
  int copies = 1;
};

void bindConfidenceTrainingOptions(CLI::App& command, ConfidenceTrainingOptions& options);
ExitCode runConfidenceTraining(const ConfidenceTrainingOptions& options);

}  // namespace skel
