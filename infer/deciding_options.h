// Which options decide what is made of a drawing, and their hash: what was made with others is made anew.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "infer/infer_options.h"

namespace skel {

// All that were given, but for those that say which drawings, where to, how fast and how loud: an option that
// is new counts unless it is named there.
std::vector<std::pair<std::string, std::vector<std::string>>> decidingOptions(const CLI::App& app);

// SHA-256. A value that is a file or a folder counts by what is in it, wherever it lies. Throws InputError.
std::string optionsHash(const InferOptions& options);

}  // namespace skel
