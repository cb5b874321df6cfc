// skel-train bones: how long the bones of drawn figures are, for the search of the best joints.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "libskel/core/error.h"

namespace skel {

struct BoneLengthsOptions {
  std::string net;                    // file of a joint net
  std::vector<std::string> drawings;  // folders, see findJointedDrawings()
  std::string output;                 // "": the net's own file
};

void bindBoneLengthsOptions(CLI::App& command, BoneLengthsOptions& options);
ExitCode runBoneLengths(const BoneLengthsOptions& options);

}  // namespace skel
