// The command `skel-animate list [FILE]`.
#pragma once

#include "animator/clip_source.h"
#include "libskel/core/error.h"

namespace skel {

struct ListOptions {
  std::string file;  // empty: the clips alone
  ClipSource clips;
};
void bindListOptions(CLI::App& app, ListOptions& options);
ExitCode runList(const ListOptions& options);

}  // namespace skel
