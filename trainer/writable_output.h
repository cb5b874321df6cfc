// Asked before long work, so that its result is not lost.
#pragma once

#include <string>
#include <string_view>

namespace skel {

// Throws OutputError unless `file` can be written, which may mean to replace it. Its folder is made.
void ensureWritableFile(const std::string& file);

// The same for a net of that format ("skel-joint-net"). Throws OutputError also where another kind of net
// lies, which took hours to learn.
void ensureWritableNet(const std::string& file, std::string_view format);

}  // namespace skel
