// skel-infer on a drawing of the repository, as a user runs it.
#pragma once

#include <string>

#include "tests/support/run_tool.h"
#include "tests/support/temp_dir.h"

inline const std::string kDrawing = SKEL_SOURCE_DIR "/datasets/characters/cap_boy.png";

// In that folder.
inline skel::ToolRun infer(const skel::TempDir& dir, const std::string& arguments) {
  return skel::runTool("cd '" + dir.path() + "' && skel-infer " + arguments);
}
