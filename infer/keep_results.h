// Drawings that are done once: what became of each lies beside its results, for a run that goes on from
// there.
#pragma once

#include <string>

#include "infer/figure_result.h"
#include "infer/infer_options.h"
#include "infer/rig_figure.h"
#include "libskel/core/progress.h"

namespace skel {

// <stem> and this: the file that says what became of a drawing, written when all its results are.
inline constexpr const char* kResultFileEnding = ".result.json";

// What is the same for all drawings of a run: `image` and `mended` are empty. Throws InputError: a file that
// an option names.
Origin originOfRun(const InferOptions& options);

// rigDrawing(), and where keepsResults(): one process at a time is at a drawing, its result file is written
// last, and with --resume a drawing whose result file has the same origin, and whose outputs are what it
// says, is left as it is. Not written where the machine failed and not the drawing: the next run tries again.
// Never throws; refuses a drawing whose results would take the place of those of another that is still there.
DrawingResult rigOnce(const InferOptions& options, const RigOptions& rig, const Origin& run, RigJob job,
                      ProgressBar& progress);

}  // namespace skel
