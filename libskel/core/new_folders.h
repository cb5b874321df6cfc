// Folders that are made for results.
#pragma once

#include <string>
#include <vector>

namespace skel {

// Those on the way to `output` that are not there yet: what is made of them and is empty in the end goes
// again. A name that ends with / is a folder's.
class NewFolders {
 public:
  explicit NewFolders(const std::string& output);
  ~NewFolders();
  NewFolders(const NewFolders&) = delete;
  NewFolders& operator=(const NewFolders&) = delete;

 private:
  std::vector<std::string> missing_;  // the deepest first
};

}  // namespace skel
