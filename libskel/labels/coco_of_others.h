// COCO annotations that somebody has made, told from those that skel-label has exported.
#pragma once

#include <string>

#include "libskel/core/json.h"

namespace skel {

// COCO has a place for who made a file.
inline constexpr const char* kCocoContributor = "skel-label export";

bool isCoco(const JsonValue& root);
bool isExportedCoco(const JsonValue& root);

// Before `path` is written over: throws OutputError where COCO annotations of others lie. `instead`: what to
// do.
void keepCocoOfOthers(const std::string& path, const std::string& instead);

}  // namespace skel
