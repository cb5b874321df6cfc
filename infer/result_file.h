// What became of a drawing, as one object of JSON: a line of --json, or a file beside the results that a
// later run goes on from (docs/scale.md).
#pragma once

#include <string>

#include "infer/figure_result.h"

namespace skel {

// On one line, without its end. `beside`: paths are as seen from that file; "": as they are.
std::string formatResult(const DrawingResult& drawing, const std::string& beside = "");

// A file that formatResult() has written, `path` its name; paths are as seen from where the tool runs.
// Without pictures and advice, which are not kept. Throws InputError.
DrawingResult parseResult(const std::string& text, const std::string& path);

}  // namespace skel
