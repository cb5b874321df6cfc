// The tools on files of a test's own folder, as a user runs them there.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

#include "libskel/core/files.h"
#include "libskel/draw/canvas.h"
#include "libskel/image/write_image.h"
#include "tests/support/catch.h"
#include "tests/support/run_tool.h"
#include "tests/support/temp_dir.h"

namespace skel {

inline ToolRun runIn(const TempDir& dir, const std::string& command) {
  return runTool("cd '" + dir.path() + "' && " + command);
}

inline ToolRun done(const TempDir& dir, const std::string& command) {
  const ToolRun run = runIn(dir, command);
  CAPTURE(command, run.err);
  REQUIRE(run.exit_code == 0);
  return run;
}

// One line, this code.
inline void refused(const TempDir& dir, const std::string& command, int exit_code,
                    const std::string& message) {
  const ToolRun run = runIn(dir, command);
  CAPTURE(command, run.err);
  CHECK(run.exit_code == exit_code);
  CHECK(run.err.find(message) != std::string::npos);
  CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
}

// cap_boy of the labelled set, with mask and labels, in that folder of the test's own.
inline void copyLabelledBoy(const TempDir& dir, const std::string& folder) {
  std::filesystem::create_directories(dir.file(folder));
  for (const char* ending : {".png", ".mask.png", ".labels.json"})
    std::filesystem::copy_file(SKEL_SOURCE_DIR "/datasets/characters/cap_boy" + std::string(ending),
                               dir.file(folder + "/cap_boy") + ending);
}

// A small figure with arms and legs.
inline Image smallFigure(double swing = 0) {
  Image image = blankImage(160, 200);
  const Color ink{30, 30, 30};
  drawDisc(image, {80, 40}, 22, ink);
  drawLine(image, {80, 60}, {80, 120}, 36, ink);
  drawLine(image, {80, 80}, {30, 110 + swing}, 14, ink);
  drawLine(image, {80, 80}, {130, 110 - swing}, 14, ink);
  drawLine(image, {72, 120}, {60 + swing, 185}, 16, ink);
  drawLine(image, {88, 120}, {100 - swing, 185}, 16, ink);
  return image;
}

inline void writeFigure(const std::string& path, double swing = 0) {
  writeFile(path, encodePng(smallFigure(swing)));
}

}  // namespace skel
