#include "libskel/core/error.h"

#include "libskel/core/text.h"

namespace skel {

Error::Error(ExitCode exit_code, const std::string& message)
    : std::runtime_error(messageLine(message)), exit_code_(exit_code) {}

InputError::InputError(const std::string& file, const std::string& problem)
    : Error(ExitCode::kInput, file + ": " + problem), file_(file), problem_(problem) {}

OutputError::OutputError(const std::string& file, const std::string& problem)
    : Error(ExitCode::kOutput, file + ": " + problem) {}

}  // namespace skel
