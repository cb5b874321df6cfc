#include "libskel/mended/earlier_picture.h"

#include <filesystem>
#include <utility>

#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/sha256.h"
#include "libskel/core/text.h"
#include "libskel/image/check_image.h"
#include "libskel/image/read_image.h"
#include "libskel/labels/label_file.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

std::string fileName(const std::string& path) { return fs::path(path).filename().string(); }

void leaveOut(std::string& file, MendedFiles& files) { files.earlier.push_back(std::exchange(file, "")); }

// Nothing of a file that cannot be read: whoever takes it up says what is wrong with it.
std::optional<LabelFile> labelsIn(const std::string& path) {
  if (path.empty()) return std::nullopt;
  try {
    return readLabelFile(path);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

// Leaves a file out that has not the picture's size. Whether it does.
bool leaveOutOtherSize(std::string& file, Eigen::Index width, Eigen::Index height, const Image& image,
                       MendedFiles& files) {
  if (width == image.width && height == image.height) return false;
  files.other_size[file] =
      "of " + sizeInPx(width, height) + " px, the picture has " + sizeInPx(image.width, image.height);
  leaveOut(file, files);
  return true;
}

// Of the files that were left out and are, or are not, of another size.
std::optional<Note> leftOutNote(const std::string& shared, const MendedFiles& files,
                                const std::vector<KeptFile>& kept, bool of_other_size) {
  std::vector<std::string> names;
  for (const std::string& file : files.earlier) {
    const auto size = files.other_size.find(file);
    if ((size != files.other_size.end()) != of_other_size) continue;
    std::string name = fileName(file), more = of_other_size ? size->second : "";
    for (const KeptFile& one : kept)
      if (one.was == file)
        more += (more.empty() ? "now " : "; now ") + fileName(one.is) +
                (one.may_be_named ? "; --skeleton " + shellWord(one.is) + " takes it up" : "");
    names.push_back(name + (more.empty() ? "" : " (" + more + ")"));
  }
  if (names.empty()) return std::nullopt;
  return Note{shared + ": " + joined(names), shared, joined(names)};
}

std::vector<std::string> numbered(const std::string& start, const std::string& end) {
  std::vector<std::string> paths;
  for (int number = 1;; ++number) {
    const std::string path = numberedName(start, end, number);
    if (std::error_code unknown; !fs::is_regular_file(path, unknown)) return paths;
    paths.push_back(path);
  }
}

const std::string& resultsOf(const MendPlace& place) {
  return place.results.empty() ? place.made : place.results;
}

// That is taken up.
std::string limbsFile(const MendRequest& request) {
  const std::string number = request.figure > 1 ? "-" + std::to_string(request.figure) : "";
  return fs::path(request.source).replace_extension().string() + number + ".limbs.png";
}

std::string lastThatFits(const std::string& results, const MendRequest& request) {
  std::string fitting;
  for (const std::string& path : numbered(results + kEarlierSkeletonStart, kEarlierSkeletonEnd)) {
    const std::optional<SkeletonSource> source = sourceOfSkeleton(path);
    if (source && source->number == request.figure && request.isOfPicture(source->image_sha256))
      fitting = path;
  }
  return fitting;
}

}  // namespace

std::string earlierThatFits(const std::vector<MendPlace>& places, const MendRequest& request) {
  for (const MendPlace& place : places)
    if (const std::string path = lastThatFits(resultsOf(place), request); !path.empty()) return path;
  return "";
}

std::vector<std::string> earlierLayers(const std::vector<MendPlace>& places) {
  for (const MendPlace& place : places)
    if (auto paths = numbered(resultsOf(place) + kEarlierLayersStart, kEarlierLayersEnd); !paths.empty())
      return paths;
  return {};
}

void leaveOutEarlier(MendedFiles& files, const MendRequest& request,
                     const std::optional<SkeletonSource>& result) {
  const bool knows_picture = result && !result->image_sha256.empty();
  const bool changed = knows_picture && !request.isOfPicture(result->image_sha256);

  const bool found_labels = files.labels != request.skeleton, found_mask = files.mask != request.mask;
  const std::string mask_sha256 = found_mask ? sha256(readFile(files.mask)) : "";
  const std::optional<LabelFile> labels = labelsIn(found_labels ? files.labels : "");
  const bool are_of_mask = labels && found_mask && labels->mask && labels->mask->sha256 == mask_sha256;
  const fs::path label_folder = fs::path(files.labels).parent_path();
  // Made for this picture in other colours: the run before has taken them up.
  const auto tookUpLabels = [&] {
    if (!labels || !knows_picture || changed) return false;
    if (!labels->hasPlacedJoint()) return are_of_mask && result->mask && result->mask->sha256 == mask_sha256;
    return result->labels && result->labels->sha256 == sha256(readFile(files.labels));
  };
  const bool took_up_labels = tookUpLabels();
  if (labels && !request.isOfPicture(labels->image.sha256) && (labels->mask || labels->hasPlacedJoint()) &&
      !took_up_labels) {
    leaveOut(files.labels, files);
    if (are_of_mask) leaveOut(files.mask, files);
  }
  // A person who has saved labels of the new picture has seen mask and limbs on it.
  const bool seen = labels && request.isOfPicture(labels->image.sha256);
  const auto isUsed = [](const std::optional<SkeletonFile::Mask>& used, const std::string& sha256) {
    return used && used->sha256 == sha256;
  };
  files.mask_before = knows_picture && found_mask && !files.mask.empty() && !(seen && are_of_mask) &&
                      isUsed(result->mask, mask_sha256) && (changed || result->mask->before);
  if (files.limbs.empty() || files.limbs == request.limbs) return;
  const bool used_limbs = knows_picture && isUsed(result->limbs, sha256(readFile(files.limbs)));
  const bool beside_labels = labels && fs::path(files.limbs).parent_path() == label_folder;
  if (beside_labels && !seen && !took_up_labels && (changed || !used_limbs))
    leaveOut(files.limbs, files);
  else
    files.limbs_before =
        !seen && (changed ? used_limbs || !result->limbs : used_limbs && result->limbs->before);
}

void leaveOutOtherSizes(MendedFiles& files, const MendRequest& request, const Image& image) {
  if (!files.has_result) return;
  const LookAtOutputs look;  // painted results stay as they are
  if (!files.mask.empty() && files.mask != request.mask) {
    const Plane8 mask = readMask(files.mask);
    if (leaveOutOtherSize(files.mask, mask.cols(), mask.rows(), image, files)) files.mask_before = false;
  }
  if (!files.limbs.empty() && files.limbs != request.limbs) {
    const Image limbs = readImage(files.limbs);
    if (leaveOutOtherSize(files.limbs, limbs.width, limbs.height, image, files)) files.limbs_before = false;
  }
}

std::vector<const char*> warningsOfEarlier(const MendedFiles& files) {
  std::vector<const char*> warnings;
  if (files.mask_before)
    warnings.push_back("the mask was there before the picture changed: look at it (skel-label FILE)");
  if (files.limbs_before)
    warnings.push_back(
        "the picture has changed, the limbs may be painted for the one before: look at them (skel-label "
        "FILE, "
        "key G)");
  return warnings;
}

std::optional<Note> earlierNote(const MendedFiles& files, const std::vector<KeptFile>& kept) {
  return leftOutNote("mended for an earlier picture of this name, not taken up for this one", files, kept,
                     false);
}

std::optional<Note> otherSizeNote(const MendedFiles& files, const std::vector<KeptFile>& kept) {
  return leftOutNote("of another size than the picture, not taken up", files, kept, true);
}

std::optional<Note> fitsAgainNote(const MendedFiles& files) {
  if (files.fits_again.empty()) return std::nullopt;
  const std::string what = fileName(files.fits_again) + " fits this picture: --skeleton ";
  const std::string shared = "mended for this very picture before it changed, and not taken up by itself";
  return Note{shared + ": " + what + shellWord(files.fits_again), shared, what + shellWord(files.fits_again)};
}

std::optional<Note> keptLayersNote(const MendedFiles& files, const MendRequest& request) {
  if (files.kept_layers.empty()) return std::nullopt;
  const std::string shared = "limbs painted for a picture of this name before, not taken up by themselves",
                    what = joined(files.kept_layers) + " (if " +
                           (files.kept_layers.size() == 1 ? "it" : "one") +
                           " is of this picture, copy it to " + shellWord(limbsFile(request)) + ")";
  return Note{shared + ": " + what, shared, what};
}

}  // namespace skel
