// Whole files in, whole files out.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace skel {

// All bytes of a file. Throws InputError (missing, a directory, unreadable).
std::string readFile(const std::string& path);

// Writes to <path>.skel-tmp, flushes it to the disk and renames it, so that `path` holds the old bytes or the
// new ones and never half of either, also where several processes write it. Who is killed leaves the
// temporary file, which the next to write `path` takes over. Makes missing parent folders. Throws
// OutputError.
void writeFile(const std::string& path, std::string_view bytes);

// Paths of all files below `dir`, at any depth, sorted. Links to folders are not followed, devices and pipes
// left out; links to nothing are in, for their readers to complain. Throws InputError: `dir` is no folder, a
// folder cannot be read.
std::vector<std::string> filesBelow(const std::string& dir);

// The path of `file` as seen from the folder that holds `other`.
std::string pathSeenFrom(const std::string& other, const std::string& file);

// Throws OutputError unless `dir` is, or can be made, a folder that can be written to.
void ensureWritableFolder(const std::string& dir);

}  // namespace skel
