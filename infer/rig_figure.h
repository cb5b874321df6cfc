// One drawing of a command line: rigged figure by figure, its files written.
#pragma once

#include <string>

#include "infer/figure_result.h"
#include "infer/infer_options.h"
#include "libskel/core/progress.h"

namespace skel {

// A drawing, and where it goes.
struct RigJob {
  std::string source;  // the file that complaints name
  std::string stem;    // of the outputs
};

// Notes all files that rigDrawing() may write (input_guard.h), so that an input among them is told of before
// any work. Throws UsageError.
void noteResults(const InferOptions& options, const RigJob& job, const std::vector<Clip>& clips);

// What is thrown on the way is the result's error. `progress` counts figures, and one for a drawing whose
// figures are not yet counted.
DrawingResult rigDrawing(const InferOptions& options, const RigOptions& rig, const RigJob& job,
                         ProgressBar& progress);

// What --back and --layers name, if that is a file.
bool isBackPicture(const std::string& back);
bool isLayerMap(const std::string& layers);

}  // namespace skel
