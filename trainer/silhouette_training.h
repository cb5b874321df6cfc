// skel-train silhouettes: learns how sure one may be of a silhouette that was found on a page.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "libskel/core/error.h"

namespace skel {

struct SilhouetteTrainingOptions {
  std::vector<std::string> drawings;  // folders, see findAnnotatedImages()
  std::string hands;
  std::string output = "out/silhouette_confidence.json";
  int folds = 5;
  int seed = 1;
  int threads = 0;
};

void bindSilhouetteTrainingOptions(CLI::App& command, SilhouetteTrainingOptions& options);
ExitCode runSilhouetteTraining(const SilhouetteTrainingOptions& options);

}  // namespace skel
