// One drawing of a command line: rigged figure by figure, its files written.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "infer/figure_result.h"
#include "infer/infer_options.h"
#include "libskel/core/progress.h"
#include "libskel/mended/former_names.h"
#include "libskel/mended/mended_files.h"

namespace skel {

// A file, read once.
struct FileBytes {
  std::string bytes, sha256;
};

// A drawing, and where it goes.
struct RigJob {
  std::string source;                              // the file that complaints name
  std::string stem;                                // of the outputs, below --out
  std::optional<FileBytes> read;                   // what is in it, where that is known
  std::shared_ptr<FormerNames> former_names = {};  // shared by all jobs of a run
};

// Notes all files that rigDrawing() may write (input_guard.h), so that an input among them is told of before
// any work. Throws UsageError.
void noteResults(const InferOptions& options, const RigJob& job, const std::vector<Clip>& clips);

// What is thrown on the way is the result's error. `progress` counts figures, and one for a drawing whose
// figures are not yet counted.
DrawingResult rigDrawing(const InferOptions& options, const RigOptions& rig, const RigJob& job,
                         ProgressBar& progress);

// The exception that is being handled becomes the error of `result`, whose source is known.
void takeError(DrawingResult& result);

// The figures that are asked for: one, or all that there may be.
struct FigureRange {
  int first = 1, last = 1;
};
FigureRange figuresAskedFor(const InferOptions& options);

// What the outputs of a figure of the drawing are called.
std::string stemOf(const InferOptions& options, const RigJob& job, int figure);

// What skel-label opens to mend it.
std::string fileToMend(const InferOptions& options, const RigJob& job, int figure);

// What a person may have made for a figure of the drawing, whose bytes have that hash.
MendRequest mendRequest(const InferOptions& options, const RigJob& job, int figure,
                        const std::string& image_sha256);

// What --back and --layers name, if that is a file.
bool isBackPicture(const std::string& back);
bool isLayerMap(const std::string& layers);

}  // namespace skel
