// The command `skel-animate view FILE`.
#pragma once

#include "animator/load_character.h"
#include "libskel/core/error.h"

namespace CLI {
class App;
}

namespace skel {

struct ViewOptions {
  CharacterSource source;
  ClipSource clips;
};
void bindViewOptions(CLI::App& app, ViewOptions& options);
ExitCode runView(const ViewOptions& options);

}  // namespace skel
