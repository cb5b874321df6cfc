#include "libskel/mended/renamed_pictures.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/folder_listing.h"
#include "libskel/core/sha256.h"
#include "libskel/image/result_picture.h"
#include "libskel/labels/label_file.h"
#include "libskel/mended/mended_files.h"
#include "libskel/skeleton/skeleton_file.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostOpened = 1000;  // skeleton files: a folder of results may hold any number

struct Orphan {
  std::string file, picture;  // path; name of the picture that is gone
  std::size_t joints = 0;     // of a skeleton, made by hand
  std::string mask = {};      // that a skeleton without such joints names; path
};
using Orphans = std::map<std::string, Orphan>;  // by the hash of the picture

// Names of label files and of drawings, whether these are asked for or not.
std::vector<std::string> filesIn(const fs::path& folder) {
  const auto isEither = [](const std::string& name) {
    return name.ends_with(kLabelFileEnding) || isDrawingName(name);
  };
  return listFolder(folder.empty() ? "." : folder.string(), isEither).files;
}

// Label files of pictures that are gone, of the `files` of the folder. Opens none beside which a picture of
// its stem lies.
Orphans orphanedLabels(const fs::path& folder, const std::vector<std::string>& files) {
  std::set<std::string> looked_after;
  for (const std::string& name : files)
    if (isDrawingName(name)) looked_after.insert(labelFileFor(name));
  Orphans orphans;
  for (const std::string& name : files) {
    if (!name.ends_with(kLabelFileEnding) || looked_after.contains(name)) continue;
    const std::string path = (folder / name).string();
    try {
      std::error_code failure;
      const LabelFile file = readLabelFile(path);
      if ((file.hasPlacedJoint() || file.mask) && !fs::exists(folder / file.image.file, failure))
        orphans.emplace(file.image.sha256, Orphan{path, file.image.file});
    } catch (const Error&) {
      // Whoever opens it is told.
    }
  }
  return orphans;
}

// "boy" of boy.skeleton.json; where all figures were rigged boy-2.skeleton.json is the boy's, too.
std::string withoutNumber(const std::string& stem) {
  const std::size_t end = stem.find_last_not_of("0123456789");
  return end != stem.npos && end + 1 < stem.size() && stem[end] == '-' ? stem.substr(0, end) : stem;
}

// Skeleton files in the folders that people mend, each looked into once.
class OrphanedSkeletons {
 public:
  // Of drawings of these stems none is looked for.
  explicit OrphanedSkeletons(std::set<std::string> stems) : stems_(std::move(stems)) {}

  const Orphans& in(const fs::path& folder) {
    std::error_code unknown;
    const auto [known, is_new] = folders_.try_emplace(fs::weakly_canonical(fs::absolute(folder), unknown));
    if (is_new) known->second = lookInto(folder);
    return known->second;
  }

 private:
  Orphans lookInto(const fs::path& folder) {
    const auto isSkeleton = [](const std::string& name) { return name.ends_with(kSkeletonFileEnding); };
    Orphans orphans;
    for (const std::string& name : listFolder(folder.string(), isSkeleton).files) {
      const std::string stem = name.substr(0, name.size() - std::string_view(kSkeletonFileEnding).size());
      if (stems_.contains(stem) || stems_.contains(withoutNumber(stem))) continue;
      if (++opened_ > kMostOpened) break;
      const std::string path = (folder / name).string();
      try {
        std::error_code failure;
        const SkeletonSource source = readSkeletonSource(path);
        if (source.image_sha256.empty() || fs::exists(folder / source.image_file, failure)) continue;
        Orphan orphan{path, fs::path(source.image_file).filename().string(), editedJoints(path)};
        if (orphan.joints == 0 && source.mask)
          if (const fs::path mask = (folder / source.mask->file).lexically_normal();
              fs::exists(mask, failure))
            orphan.mask = mask.string();
        if (orphan.joints > 0 || !orphan.mask.empty())
          orphans.emplace(source.image_sha256, std::move(orphan));
      } catch (const Error&) {
        // Whoever opens it is told.
      }
    }
    return orphans;
  }

  std::set<std::string> stems_;
  std::map<fs::path, Orphans> folders_;
  std::size_t opened_ = 0;
};

// Labels as skel-label candidates makes them are none; those that cannot be read may be anything.
bool hasLabels(const std::string& picture) {
  const std::string path = labelFileFor(picture);
  std::error_code failure;
  if (!fs::exists(path, failure)) return false;
  try {
    const LabelFile file = readLabelFile(path);
    const auto is_given = [](const auto& label) { return label.has_value(); };
    return file.hasPlacedJoint() || file.mask ||
           std::any_of(file.labels.begin(), file.labels.end(), is_given);
  } catch (const Error&) {
    return true;
  }
}

// Nothing is said where a person has mended the picture under its new name.
bool isMended(const std::string& picture, const std::string& picture_sha256, const std::string& out_dir) {
  MendRequest request;
  request.source = picture;
  request.image_sha256 = picture_sha256;
  if (!out_dir.empty()) request.results = out_dir + "/" + fs::path(picture).stem().string();
  const MendedFiles files = mendedFiles(request);
  return !files.skeleton.empty() || !files.mask.empty();
}

std::string noteOnLabels(const Orphan& labels, const std::string& picture) {
  return labels.file + " is of " + picture + ", which was called " + labels.picture +
         " then: call it so again, and what was mended is taken up";
}

std::string noteOnSkeleton(const Orphan& skeleton, const std::string& picture) {
  if (!skeleton.mask.empty())
    return skeleton.mask + " was made for " + picture + ", which was called " + skeleton.picture +
           " then: call it so again, or the mask " + fs::path(picture).stem().string() + ".mask.png";
  const std::string was = fs::path(skeleton.picture).stem().string(),
                    name = fs::path(skeleton.file).filename().string();
  const std::string number = name.starts_with(was + "-") ? name.substr(was.size()) : kSkeletonFileEnding;
  return skeleton.file + " is of " + picture + ", " + std::to_string(skeleton.joints) +
         (skeleton.joints == 1 ? " joint" : " joints") + " made by hand: call it " +
         fs::path(picture).stem().string() + number +
         ", in the place of one that is there, or name it by --skeleton";
}

}  // namespace

std::vector<std::string> renamedNotes(const std::vector<std::string>& drawings, const std::string& out_dir) {
  struct Folder {
    std::vector<std::string> files, pictures;  // names of what lies there; paths of what is asked for
  };
  std::map<fs::path, Folder> by_folder;
  std::set<std::string> stems;
  for (const std::string& drawing : drawings) {
    by_folder[fs::path(drawing).parent_path()].pictures.push_back(drawing);
    stems.insert(fs::path(drawing).stem().string());
  }
  for (auto& [path, folder] : by_folder) {
    folder.files = filesIn(path);
    for (const std::string& file : folder.files)
      if (isDrawingName(file)) stems.insert(fs::path(file).stem().string());
  }
  OrphanedSkeletons skeletons(std::move(stems));
  std::vector<std::string> notes;
  for (const auto& [folder, there] : by_folder) {
    const Orphans labels = orphanedLabels(folder, there.files);
    Orphans of_skeletons;
    std::vector<fs::path> places = {folder.empty() ? "." : folder, folder / "out", "out"};
    if (!out_dir.empty()) places.insert(places.begin(), out_dir);
    for (const fs::path& place : places) {
      const Orphans& more = skeletons.in(place);
      of_skeletons.insert(more.begin(), more.end());
    }
    if (labels.empty() && of_skeletons.empty()) continue;
    for (const std::string& picture : there.pictures) {
      std::error_code failure;
      if (!fs::is_regular_file(picture, failure) || hasLabels(picture)) continue;
      try {
        const std::string hash = sha256(readFile(picture));
        if (const auto orphan = labels.find(hash); orphan != labels.end())
          notes.push_back(noteOnLabels(orphan->second, picture));
        else if (const auto skeleton = of_skeletons.find(hash);
                 skeleton != of_skeletons.end() && skeleton->second.picture != fs::path(picture).filename() &&
                 !isMended(picture, hash, out_dir))
          notes.push_back(noteOnSkeleton(skeleton->second, picture));
      } catch (const Error&) {
        // The drawing's own line says so.
      }
    }
  }
  return notes;
}

}  // namespace skel
