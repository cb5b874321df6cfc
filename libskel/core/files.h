// Whole files in, whole files out.
#pragma once

#include <string>
#include <string_view>

namespace skel {

// All bytes of a file. Throws InputError (missing, a directory, unreadable).
std::string readFile(const std::string& path);

// Writes to a temporary name beside `path`, flushes it to the disk and renames it, so that `path` holds the
// old bytes or the new ones and never half of either. Makes missing parent folders. Throws OutputError.
void writeFile(const std::string& path, std::string_view bytes);

// Throws OutputError unless `dir` is, or can be made, a folder that can be written to.
void ensureWritableFolder(const std::string& dir);

}  // namespace skel
