// The command `skel-animate info FILE`.
#pragma once

#include <string>

#include "libskel/core/error.h"

namespace CLI {
class App;
}

namespace skel {

struct InfoOptions {
  std::string file, skeleton;
};
void bindInfoOptions(CLI::App& app, InfoOptions& options);
ExitCode runInfo(const InfoOptions& options);

}  // namespace skel
