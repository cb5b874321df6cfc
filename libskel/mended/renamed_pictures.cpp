#include "libskel/mended/renamed_pictures.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
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
  std::vector<std::string> stems;  // of label files
  std::set<std::string> others;
  std::error_code failure;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, failure), end; entry != end;
       entry.increment(failure)) {
    if (failure) break;
    const std::string name = entry->path().filename().string();
    if (name.ends_with(kLabelFileEnding))
      stems.push_back(name.substr(0, name.size() - std::string_view(kLabelFileEnding).size()));
    else
      others.insert(fs::path(name).stem().string());
  }
  std::sort(stems.begin(), stems.end());
  std::map<std::string, Orphan> orphans;
  for (const std::string& stem : stems) {
    if (others.contains(stem)) continue;
    const std::string file = (folder / (stem + kLabelFileEnding)).string();
    try {
      const LabelFile labels = readLabelFile(file);
      if ((labels.hasPlacedJoint() || labels.mask) && !fs::exists(folder / labels.image.file, failure))
        orphans.emplace(labels.image.sha256, Orphan{file, labels.image.file});
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
