// A ConfidenceNet in JSON, as the files of those who have one hold it.
#pragma once

#include <string>
#include <vector>

#include "libskel/core/json.h"
#include "libskel/recognition/confidence_model.h"

namespace skel {

// Throws InputError unless the inputs are those named.
ConfidenceNet confidenceNetAt(const JsonValue& value, const std::vector<std::string>& inputs);
std::string formatConfidenceNet(const ConfidenceNet& net, const std::vector<std::string>& inputs);

}  // namespace skel
