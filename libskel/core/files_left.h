// What a window has read or written, so that it does not write over what another program has put there since.
#pragma once

#include <map>
#include <string>

namespace skel {

class FilesLeft {
 public:
  // `path` is as it is left: it has been read, or written, or is not there.
  void note(const std::string& path);
  // Whether it has other content since then. False for a file that was never noted.
  bool hasChanged(const std::string& path) const;

 private:
  std::map<std::string, std::string> sha256_;  // "": not there, or cannot be read
};

}  // namespace skel
