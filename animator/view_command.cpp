#include "animator/view_command.h"

#include <CLI/CLI.hpp>

#include "animator/animation_window.h"

namespace skel {

void bindViewOptions(CLI::App& app, ViewOptions& options) {
  app.add_option("file", options.file, "A rigged character (.glb), or a drawing, which is rigged first")
      ->required()
      ->type_name("FILE");
  app.add_option("--template", options.body_plan, "Body plan of a drawing: a name or a file")
      ->capture_default_str();
}

ExitCode runView(const ViewOptions& options) { return runAnimationWindow(options.file, options.body_plan); }

}  // namespace skel
