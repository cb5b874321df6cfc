#include "libskel/core/folder_listing.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "libskel/core/file_names.h"
#include "libskel/core/natural_order.h"

namespace skel {
namespace fs = std::filesystem;

namespace {

// Without the separator that a folder's name may end with.
fs::path absolute(const fs::path& path) {
  std::error_code gone;  // the process's own folder
  const fs::path whole = fs::absolute(path, gone).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

}  // namespace

FolderListing listFolder(const std::string& folder, const std::function<bool(const std::string&)>& shows) {
  FolderListing listing;
  listing.folder = absolute(folder).string();
  std::error_code failure;
  for (fs::directory_iterator entry(listing.folder, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    const std::string name = entry->path().filename().string();
    std::error_code unknown;
    if (name.starts_with('.')) continue;
    if (entry->is_directory(unknown))
      listing.folders.push_back(name);
    else if (!shows || shows(name))
      listing.files.push_back(name);
  }
  if (failure) listing.problem = "cannot be read: " + failure.message();
  std::sort(listing.folders.begin(), listing.folders.end(), comesBefore);
  std::sort(listing.files.begin(), listing.files.end(), comesBefore);
  return listing;
}

std::string folderAround(const std::string& path) {
  std::error_code unknown;
  fs::path folder = absolute(path);
  while (folder.has_relative_path() && !fs::is_directory(folder, unknown)) folder = folder.parent_path();
  return folder.string();
}

std::string pathIn(const std::string& folder, const std::string& name) {
  std::error_code gone;
  const fs::path path = fs::path(folder) / name;
  if (fs::path(name).is_absolute()) return name;
  const fs::path below = path.lexically_relative(fs::current_path(gone));
  return below.empty() || *below.begin() == ".." ? path.string() : below.string();
}

std::string withEnding(const std::string& typed, const std::string& ending) {
  constexpr std::array<std::string_view, 9> kOwn = {".json", ".glb", ".obj", ".bvh", ".yaml",
                                                    ".png",  ".mp4", ".gif", ".webp"};
  if (typed.empty() || typed.ends_with('/')) return typed;
  return std::find(kOwn.begin(), kOwn.end(), endingOf(typed)) != kOwn.end() ? typed : typed + ending;
}

}  // namespace skel
