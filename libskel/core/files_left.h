// What a window has read or written, so that it does not write over what another program has put there since.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

namespace skel {

class FilesLeft {
 public:
  // `path` is as it is left: it has been read, or written, or is not there.
  void note(const std::string& path);
  // The same of one that this window does not read: by its length and the time of its last change.
  void noteUnread(const std::string& path);
  // Whether it has other content since then. False for a file that was never noted.
  bool hasChanged(const std::string& path) const;

 private:
  using Stamp = std::pair<std::uintmax_t, std::filesystem::file_time_type>;
  static Stamp stampOf(const std::string& path);

  std::map<std::string, std::string> sha256_;  // "": not there, or cannot be read
  std::map<std::string, Stamp> unread_;        // others
};

}  // namespace skel
