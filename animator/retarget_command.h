// The command `skel-animate retarget MOTION.bvh --to FILE.glb -o OUT`.
#pragma once

#include <string>

#include "libskel/core/error.h"

namespace CLI {
class App;
}

namespace skel {

struct RetargetCommandOptions {
  std::string motion, target, output;
  std::string name;  // of the clip; empty: the motion's file
};
void bindRetargetOptions(CLI::App& app, RetargetCommandOptions& options);
ExitCode runRetarget(const RetargetCommandOptions& options);

}  // namespace skel
