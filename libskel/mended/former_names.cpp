#include "libskel/mended/former_names.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/folder_listing.h"
#include "libskel/core/input_guard.h"
#include "libskel/image/result_picture.h"
#include "libskel/labels/label_file.h"
#include "libskel/mended/mended_files.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostOpened = 10'000;  // files of a folder: one of results may hold any number
constexpr std::size_t kHashLength = 64;

// All quoted runs of hexadecimal digits that are as long as a hash.
std::vector<std::string> hashesIn(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::vector<std::string> hashes;
  for (std::size_t at = text.find('"'); at != text.npos; at = text.find('"', at + 1)) {
    const std::size_t end = at + 1 + kHashLength;
    if (end < text.size() && text[end] == '"' &&
        text.substr(at + 1, kHashLength).find_first_not_of(kDigits) == text.npos)
      hashes.emplace_back(text.substr(at + 1, kHashLength));
  }
  return hashes;
}

// Nothing of a file that cannot be read: whoever opens it by its name is told.
template <class Read>
auto readOrNothing(const Read& read) -> std::optional<decltype(read())> {
  try {
    return read();
  } catch (const Error&) {
    return std::nullopt;
  }
}

bool isGoneOrThis(const fs::path& named, const std::string& drawing) {
  std::error_code failure;
  return !fs::exists(named, failure) || fs::equivalent(named, drawing, failure);
}

FormerPlace& placeNamed(const fs::path& made, const std::string& picture, std::vector<FormerPlace>& places) {
  for (FormerPlace& there : places)
    if (there.place.made == made) return there;
  FormerPlace place;
  place.place.made = made.string();
  place.place.is_of_picture = true;
  place.name = picture;
  places.push_back(std::move(place));
  return places.back();
}

// Of the picture of that hash, which is gone under the name that they know, or is the drawing.
std::optional<LabelFile> labelsOf(const std::string& image_sha256, const std::string& drawing,
                                  const std::string& path) {
  std::optional<LabelFile> labels = readOrNothing([&] { return readLabelFile(path); });
  if (!labels || labels->image.sha256 != image_sha256 ||
      !isGoneOrThis(fs::path(path).parent_path() / labels->image.file, drawing))
    return std::nullopt;
  return labels;
}

void addLabels(const std::string& path, const MendRequest& request, std::vector<FormerPlace>& places) {
  const auto labels = labelsOf(request.image_sha256, request.source, path);
  if (!labels) return;
  const std::string made = path.substr(0, path.size() - std::string_view(kLabelFileEnding).size());
  placeNamed(made, labels->image.file, places).labels = path;
}

void addSkeleton(const std::string& path, const MendRequest& request, std::vector<FormerPlace>& places) {
  const std::optional<SkeletonSource> source = sourceOfSkeleton(path);
  if (!source || source->image_sha256 != request.image_sha256 || source->number != request.figure) return;
  const fs::path folder = fs::path(path).parent_path(), picture = source->image_file;
  if (!isGoneOrThis(folder / picture, request.source)) return;
  MendPlace& place = placeNamed(folder / picture.stem(), picture.filename().string(), places).place;
  if (place.result) return;
  place.results = path.substr(0, path.size() - std::string_view(kSkeletonFileEnding).size());
  place.result = source;
}

// When a person or a run wrote there last.
fs::file_time_type lastWritten(const FormerPlace& former) {
  fs::file_time_type last = fs::file_time_type::min();
  const auto look = [&](const std::string& path) {
    std::error_code not_there;
    if (const auto time = fs::last_write_time(path, not_there); !not_there) last = std::max(last, time);
  };
  if (!former.place.results.empty()) look(former.place.results + kSkeletonFileEnding);
  if (!former.labels.empty()) look(former.labels);
  return last;
}

void sortNewestFirst(std::vector<FormerPlace>& places) {
  std::vector<std::pair<fs::file_time_type, FormerPlace>> dated;
  for (FormerPlace& place : places) dated.emplace_back(lastWritten(place), std::move(place));
  std::stable_sort(dated.begin(), dated.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = std::move(dated[i].second);
}

std::vector<fs::path> foldersOf(const MendRequest& request) {
  std::vector<fs::path> folders;
  const fs::path drawing = fs::path(request.source).lexically_normal(), beside = drawing.parent_path();
  if (!request.results.empty()) folders.push_back(fs::path(request.results).parent_path());
  if (!request.out_dir.empty()) {
    folders.emplace_back(request.out_dir);
    if (const auto kept = keptFolder(request.out_dir, request.source)) folders.push_back(*kept);
  }
  folders.insert(folders.end(), {beside, beside / "out", "out"});
  std::set<fs::path> seen;
  std::erase_if(folders, [&](const fs::path& folder) { return !seen.insert(wholePath(folder)).second; });
  return folders;
}

}  // namespace

const FormerNames::Folder& FormerNames::lookInto(const fs::path& folder) {
  const auto [known, is_new] = folders_.try_emplace(wholePath(folder));
  Folder& here = known->second;
  if (!is_new) return here;
  const auto isOurs = [](const std::string& name) {
    return isLabelFile(name) || name.ends_with(kSkeletonFileEnding) || isDrawingName(name);
  };
  std::vector<std::string> files = listFolder(folder.empty() ? "." : folder.string(), isOurs).files;
  std::set<std::string> of_drawings;
  for (const std::string& name : files)
    if (isDrawingName(name)) of_drawings.insert(labelFileFor(name));
  std::erase_if(files,
                [&](const std::string& name) { return isDrawingName(name) || of_drawings.contains(name); });
  files.resize(std::min(files.size(), kMostOpened));
  const LookAtOutputs look;
  for (const std::string& name : files) {
    here.labels_alone |= isLabelFile(name);
    if (const auto text = readOrNothing([&] { return readFile((folder / name).string()); }))
      for (const std::string& hash : hashesIn(*text)) here.by_hash.emplace(hash, name);
  }
  return here;
}

std::vector<std::string> FormerNames::filesWith(const std::string& sha256, const fs::path& folder) {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> found;
  for (auto [file, end] = lookInto(folder).by_hash.equal_range(sha256); file != end; ++file)
    if (std::find(found.begin(), found.end(), file->second) == found.end()) found.push_back(file->second);
  return found;
}

bool FormerNames::hasLabelsAlone(const fs::path& folder) {
  const std::lock_guard lock(mutex_);
  return lookInto(folder).labels_alone;
}

std::string formerLabels(const std::string& drawing, const std::string& image_sha256, FormerNames& names) {
  const fs::path folder = fs::path(drawing).parent_path();
  for (const std::string& name : names.filesWith(image_sha256, folder)) {
    const std::string path = (folder / name).string();
    if (!isLabelFile(name) || path == labelFileFor(drawing)) continue;
    if (const auto labels = labelsOf(image_sha256, drawing, path); labels && !labels->isBlank()) return path;
  }
  return "";
}

std::vector<FormerPlace> formerPlaces(const MendRequest& request, const std::vector<MendPlace>& places) {
  FormerNames own_names;
  FormerNames& names = request.former_names ? *request.former_names : own_names;
  const auto isKnown = [&](const fs::path& made) {
    return std::any_of(places.begin(), places.end(),
                       [&](const MendPlace& place) { return wholePath(place.made) == wholePath(made); });
  };
  std::vector<FormerPlace> all;
  const fs::path beside = fs::path(request.source).parent_path();
  for (const fs::path& folder : foldersOf(request)) {
    std::vector<FormerPlace> here;
    for (const std::string& name : names.filesWith(request.image_sha256, folder)) {
      const std::string path = (folder / name).string();
      if (isLabelFile(name))
        addLabels(path, request, here);
      else
        addSkeleton(path, request, here);
    }
    sortNewestFirst(here);
    for (FormerPlace& place : here) {
      if (isKnown(place.place.made)) continue;
      place.place.is_beside = wholePath(folder) == wholePath(beside);
      all.push_back(std::move(place));
    }
  }
  return all;
}

}  // namespace skel
