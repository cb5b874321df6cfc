// The command `skel-animate retarget MOTION --to FILE.glb -o OUT`.
#pragma once

#include <string>
#include <vector>

#include "animator/clip_source.h"
#include "libskel/core/error.h"

namespace CLI {
class App;
}

namespace skel {

struct RetargetCommandOptions {
  std::vector<std::string> motions;  // as named: one more is refused
  std::string motion, target, output;
  std::string name;  // of the clip; empty: the motion's
  ClipSource clips;
};
void bindRetargetOptions(CLI::App& app, RetargetCommandOptions& options);
ExitCode runRetarget(const RetargetCommandOptions& options);

}  // namespace skel
