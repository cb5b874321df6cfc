// Options that name a file which a tool writes say so: ->check(outputFile()). Every other word of the command
// line that names a file names an input (input_guard.h): who forgets the mark is refused as soon as the file
// is there.
#pragma once

#include <CLI/CLI.hpp>

#include "libskel/core/input_guard.h"

namespace skel {

CLI::Validator outputFile();
// Inputs, not all of which are taken: the tool calls noteInput() for those that are.
CLI::Validator pickedFiles();

// Notes the files and pipes that the command line names, and the outputs' defaults; where an output is the
// standard output, it stands there alone (standard_output.h). Throws UsageError where an output is an input.
void noteFiles(const CLI::App& app);

}  // namespace skel
