#include "animator/view_command.h"

#include <CLI/CLI.hpp>

#include "animator/animation_window.h"

namespace skel {

void bindViewOptions(CLI::App& app, ViewOptions& options) {
  bindCharacterSource(app, options.source);
  bindClipSource(app, options.clips);
}

ExitCode runView(const ViewOptions& options) { return runAnimationWindow(options.source, options.clips); }

}  // namespace skel
