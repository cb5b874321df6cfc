// The files that skel-infer writes for one figure.
#pragma once

#include <string>
#include <vector>

#include "infer/figure_result.h"
#include "infer/infer_options.h"
#include "libskel/pipeline/rig_character.h"
#include "libskel/skeleton/skeleton_file.h"

namespace skel {

std::vector<std::string> allFormats();
// All of them, for --help.
std::string formatNames();

// Whether this format is asked for.
bool writes(const InferOptions& options, const char* format);

// How far a drawing has to be rigged for what is asked for.
LastStage lastStageFor(const InferOptions& options);

// Notes these files (input_guard.h) for a character that gets `clips`. Throws UsageError: one is an input, a
// format cannot name files by this stem.
void noteOutputs(const InferOptions& options, const std::string& stem, const std::vector<Clip>& clips);

// Writes options.out_dir/<stem>.* in the formats asked for and returns the files in that order. Nothing is
// written before all of them are ready. `stem` may begin with folders. `painted`: those that a person has
// painted and that stay as they are. Throws OutputError.
std::vector<WrittenFile> writeOutputs(const InferOptions& options, const std::string& stem,
                                      const RiggedDrawing& drawing, const SkeletonFile& file,
                                      const std::vector<std::string>& painted);

}  // namespace skel
