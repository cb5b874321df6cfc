// The command `skel-animate view FILE`.
#pragma once

#include <string>

#include "libskel/core/error.h"

namespace CLI {
class App;
}

namespace skel {

struct ViewOptions {
  std::string file;
  std::string body_plan = "biped";
};
void bindViewOptions(CLI::App& app, ViewOptions& options);
ExitCode runView(const ViewOptions& options);

}  // namespace skel
