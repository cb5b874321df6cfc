// How a person starts a tool of skel, for messages that say what to do next.
#pragma once

#include <string>

namespace skel {

// Of the tool that lies beside the running program, as a word of a shell's line in this folder: its name
// where PATH leads to it or none lies there, else its path.
std::string toolCommand(const std::string& name);

}  // namespace skel
