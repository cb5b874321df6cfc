// Asked before long work, so that its result is not lost.
#pragma once

#include <string>

namespace skel {

// Throws OutputError unless `file` can be written, which may mean to replace it. Its folder is made.
void ensureWritableFile(const std::string& file);

}  // namespace skel
