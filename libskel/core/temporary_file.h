// A file under a name of its own until it is whole.
#pragma once

#include <string>
#include <string_view>

namespace skel {

// All of it to an open file. False: errno says why.
bool writeAll(int fd, std::string_view bytes);

// <target>.skel-tmp, open for writing and locked: one writer of `target` at a time, in all processes.
class TemporaryFile {
 public:
  // Waits until no other writer is at it. What a killed one has left is thrown away. fd() < 0: it cannot be
  // made, errno says why.
  explicit TemporaryFile(std::string target);
  // Gone, unless it has become the target.
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  int fd() const { return fd_; }
  // What is in it stays, also where the machine loses its power. False: errno says why.
  bool flush();
  // Gives it the target's name. False: errno says why.
  bool becomeTarget();

 private:
  std::string target_, path_;
  int fd_ = -1, slot_ = -1;
};

// SIGHUP, SIGINT and SIGTERM, unless they are ignored, take the temporary files with them: the process dies
// by the signal, as it would have.
void removeTemporaryFilesOnSignals();

// What SIGINT (Ctrl+C) then says on stderr, at the end: how to go on. Each call replaces the text before.
void sayOnInterrupt(const std::string& text);

}  // namespace skel
