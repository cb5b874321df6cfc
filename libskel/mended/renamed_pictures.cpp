#include "libskel/mended/renamed_pictures.h"

#include <filesystem>
#include <map>
#include <set>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/folder_listing.h"
#include "libskel/core/sha256.h"
#include "libskel/labels/label_file.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

struct Orphan {
  std::string labels, picture;
};

// Label files of pictures that are gone, by the hash of those. Opens none beside which a file of its stem
// lies.
std::map<std::string, Orphan> orphansIn(const fs::path& folder) {
  const std::vector<std::string> files = listFolder(folder.empty() ? "." : folder.string()).files;
  std::set<std::string> looked_after;
  for (const std::string& file : files) looked_after.insert(labelFileFor(file));
  std::map<std::string, Orphan> orphans;
  for (const std::string& file : files) {
    if (!file.ends_with(kLabelFileEnding) || looked_after.contains(file)) continue;
    const std::string path = (folder / file).string();
    try {
      std::error_code failure;
      const LabelFile labels = readLabelFile(path);
      if ((labels.hasPlacedJoint() || labels.mask) && !fs::exists(folder / labels.image.file, failure))
        orphans.emplace(labels.image.sha256, Orphan{path, labels.image.file});
    } catch (const Error&) {
      // Whoever opens it is told.
    }
  }
  return orphans;
}

}  // namespace

std::vector<std::string> renamedNotes(const std::vector<std::string>& drawings) {
  std::map<fs::path, std::vector<std::string>> by_folder;
  for (const std::string& drawing : drawings) by_folder[fs::path(drawing).parent_path()].push_back(drawing);
  std::vector<std::string> notes;
  for (const auto& [folder, pictures] : by_folder) {
    const std::map<std::string, Orphan> orphans = orphansIn(folder);
    if (orphans.empty()) continue;
    for (const std::string& picture : pictures) {
      std::error_code failure;
      if (!fs::is_regular_file(picture, failure) || fs::exists(labelFileFor(picture), failure)) continue;
      try {
        if (const auto orphan = orphans.find(sha256(readFile(picture))); orphan != orphans.end())
          notes.push_back(orphan->second.labels + " is of " + picture + ", which was called " +
                          orphan->second.picture +
                          " then: call it so again, and what was mended is taken up");
      } catch (const Error&) {
        // The drawing's own line says so.
      }
    }
  }
  return notes;
}

}  // namespace skel
