// What a folder holds, to choose from.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace skel {

struct FolderListing {
  std::string folder;                       // absolute
  std::vector<std::string> folders, files;  // names, in natural order
  std::string problem;                      // why there are none; else empty
};

// Without what is hidden, and without files that `shows` says no of; where that is empty, with all.
FolderListing listFolder(const std::string& folder,
                         const std::function<bool(const std::string& name)>& shows = {});

// The folder that `path` is or lies in, absolute: the next above that is there.
std::string folderAround(const std::string& path);

// `name` in `folder`, seen from where the process is if it lies below; an absolute `name` stays as it is.
std::string pathIn(const std::string& folder, const std::string& name);

// A name that somebody has typed, with the `ending` of what is saved: throw, throw.clip.json. It stays where
// it has an ending of skel's own files already, leads to a folder (a '/' at its end) or is empty.
std::string withEnding(const std::string& typed, const std::string& ending);

}  // namespace skel
