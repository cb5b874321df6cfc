// The commands of skel-label, bound to the command line.
#pragma once

#include <functional>
#include <string>

#include "labeler/import_labels.h"
#include "libskel/core/error.h"

namespace CLI {
class App;
}

namespace skel {

struct LabelerOptions {
  std::string path;  // of the window: a folder, a picture, a skeleton file or a motion file
  std::string weights;
  std::string body_plan = "auto";
  std::string recognizer = "tree";
  std::string dir;  // of the other commands
  ImportOptions import;
  bool coco = false, csv = false;
  std::string output;
  double frame_rate = 12;  // 1/s
  bool force = false;      // of motion and export
};

// Adds all options and commands; those that are chosen set `run` to a function that returns the exit code.
void bindCommands(CLI::App& app, LabelerOptions& options, std::function<ExitCode()>& run);

}  // namespace skel
