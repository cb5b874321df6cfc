// What a program reads is not written over by it, once it has called guardInputs(): skel's tools do, a
// program that uses the library may; one that does not is not protected. readFile() and writeFile() keep the
// lists themselves, so that no tool can forget a file that another one names (a skeleton's mask, the pictures
// of an OBJ, the frames of a film); a tool that says early what it is going to write is refused before any
// work. Files are told apart by device and inode: neither `./x`, a link nor another spelling of a folder
// hides one.
//
// A pipe that nobody writes to is waited for, for ever: only those that the user names are opened, not what
// lies in a folder or what a file names.
#pragma once

#include <sys/stat.h>

#include <cstddef>
#include <string>

#include "libskel/core/error.h"

namespace skel {

// An output is an input. The whole command line is wrong then, not one of several drawings: whoever goes on
// after the failure of one lets this pass.
struct OverwriteError : UsageError {
  using UsageError::UsageError;
};

// From now on, for the whole process. Tools call it (libskel/cli/tool.h); a program that uses the library
// may.
void guardInputs();

// `path` is read. Does nothing where there is no such file, or where this program has written it. Throws
// OverwriteError if noteOutput() has been told of it; it is an input for all that.
void noteInput(const std::string& path);

// `path` is going to be written. Throws OverwriteError if it is an input.
void noteOutput(const std::string& path);

// The same, and refuses two outputs that are one file, also one that is not there yet (UsageError). Throws
// OutputError where there cannot be one: a link to itself, a name that is too long.
void noteNamedOutput(const std::string& path);

// `path` stands on the command line: if it is a pipe, it may be opened.
void notePipe(const std::string& path);

// Whether a pipe may be opened: noted, or there is no guard.
bool mayOpenPipe(const struct stat& pipe);

// For writeFile(): `before` has been replaced by `after`, which is this program's own.
void noteReplaced(const struct stat* before, const struct stat& after);

// While it lives, files that this thread reads are looked at because they are to be replaced (does this
// motion hold joints that somebody has placed?): they do not become inputs.
class LookAtOutputs {
 public:
  LookAtOutputs();
  ~LookAtOutputs();
  LookAtOutputs(const LookAtOutputs&) = delete;
  LookAtOutputs& operator=(const LookAtOutputs&) = delete;
};

// While it lives, what this thread notes is noted for now: forgotten at its end, so that the lists do not
// grow with the number of pieces of work, whose files are not each other's. One a thread at a time.
class NotedForNow {
 public:
  NotedForNow();
  ~NotedForNow();
  NotedForNow(const NotedForNow&) = delete;
  NotedForNow& operator=(const NotedForNow&) = delete;
};

// How many files are on the lists.
std::size_t notedFiles();

}  // namespace skel
