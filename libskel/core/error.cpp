#include "libskel/core/error.h"

namespace skel {

InputError::InputError(const std::string& file, const std::string& problem)
    : Error(ExitCode::kInput, file + ": " + problem), file_(file), problem_(problem) {}

OutputError::OutputError(const std::string& file, const std::string& problem)
    : Error(ExitCode::kOutput, file + ": " + problem) {}

}  // namespace skel
