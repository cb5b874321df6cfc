// Options that name a file which a tool writes say so: ->check(outputFile()). Every other word of the command
// line that names a file names an input (input_guard.h): who forgets the mark is refused as soon as the file
// is there. Of its formats it says which one the option writes, so that no file of another one is replaced:
// labels by weights.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "libskel/core/input_guard.h"

namespace skel {

// `format`: that the file has ("skel-weights"); "": none of skel's.
CLI::Validator outputFile(const std::string& format = "");
// One of several of skel's formats: the tool calls keepOtherFormats() (own_format.h), or reads it.
inline constexpr const char* kAnyFormat = "any";
// Inputs, not all of which are taken: the tool calls noteInput() for those that are.
CLI::Validator pickedFiles();

// Notes the files and pipes that the command line names, and the outputs' defaults; where an output is the
// standard output, it stands there alone (standard_output.h). Throws UsageError where an output is an input,
// OutputError where it is a file of another of skel's formats.
void noteFiles(const CLI::App& app);

}  // namespace skel
