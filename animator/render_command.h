// The command `skel-animate render WHAT... --clip NAME|FILE,... -o FILM|FILMS/`.
#pragma once

#include "animator/render_options.h"
#include "libskel/core/error.h"

namespace skel {

ExitCode runRender(const RenderCommandOptions& options);

}  // namespace skel
