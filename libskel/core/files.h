// Whole files in, whole files out. writeFile() replaces what the program has read, too, unless it has called
// guardInputs() (input_guard.h), as skel's tools do: then what is read becomes an input, which is never
// written over.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace skel {

// All bytes of a file. What comes out of a pipe is kept: whoever reads it again gets the same. Throws
// InputError (missing, a directory, a device, a pipe that may not be opened (input_guard.h), unreadable).
std::string readFile(const std::string& path);

// Writes to <path>.skel-tmp, flushes it to the disk and renames it, so that `path` holds the old bytes or the
// new ones and never half of either, also where several processes write it. Who is killed leaves the
// temporary file, which the next to write `path` takes over. Makes missing parent folders. A link stays one
// and its target is written; a file that is replaced keeps its mode and its owner; devices and pipes
// (those that may be opened) are written to. Throws OutputError; after guardInputs() UsageError for an input.
void writeFile(const std::string& path, std::string_view bytes);

// The same for documents that are edited in place: `path` may be an input, guarded or not.
void replaceFile(const std::string& path, std::string_view bytes);

// Paths of all files below `dir`, at any depth, sorted. Links to folders are not followed, devices and pipes
// left out; links to nothing are in, for their readers to complain. Throws InputError: `dir` is no folder, a
// folder cannot be read.
std::vector<std::string> filesBelow(const std::string& dir);

// The path of `file` as seen from the folder that holds `other`.
std::string pathSeenFrom(const std::string& other, const std::string& file);

// Throws OutputError unless `dir` is, or can be made, a folder that can be written to.
void ensureWritableFolder(const std::string& dir);
// The same of the folder that `file` will stand in.
void ensureWritableFolderOf(const std::string& file);

// While it lives, others that want it wait, in this process and in others: for folders in which several files
// belong together. The folder must be there. Throws OutputError.
class FolderLock {
 public:
  explicit FolderLock(const std::string& dir);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int fd_;
};

}  // namespace skel
