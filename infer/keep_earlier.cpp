#include "infer/keep_earlier.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "infer/outputs.h"
#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/image/sealed_png.h"
#include "libskel/import/read_character.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// From `path` to <start>, a number where that is taken, <end>; returns what it is called now.
std::string keepAs(const std::string& path, const std::string& start, const std::string& end) {
  const std::string kept = freeNumberedName(start, end);
  std::error_code failure;
  fs::rename(path, kept, failure);
  if (failure) throw OutputError(path, "cannot be kept as " + kept + ": " + failure.message());
  return kept;
}

// Whether limbs beside the result of that skeleton file are taken up for the picture and the figure of
// `file`.
bool isOfThis(const std::optional<SkeletonSource>& result, const SkeletonFile& file) {
  if (!result || result->number != file.figure.number) return false;
  return result->image_sha256.empty() || result->image_sha256 == file.image_sha256 ||
         (!file.foundOutline().empty() && result->found_outline_sha256 == file.foundOutline() &&
          result->image_width == file.image_width && result->image_height == file.image_height);
}

std::string whyNotTakenUp(const std::string& path, const MendedFiles& files, const InferOptions& options,
                          const std::optional<SkeletonSource>& result, const SkeletonFile& file) {
  if (const auto size = files.other_size.find(path); size != files.other_size.end())
    return "it is " + size->second;
  if (!result) return "no skeleton file beside it says that it is of this figure";
  if (result->number != file.figure.number) return "it is of figure " + std::to_string(result->number);
  if (!isOfThis(result, file)) return "the picture has changed";
  if (options.layers != "auto") return "--layers asks for others";
  if (!options.model_file.empty()) return "--model is a body of its own";
  if (files.limbs.empty()) return "the picture has changed";
  return fs::path(files.limbs).filename().string() + " comes first";
}

}  // namespace

std::vector<KeptFile> keepEarlier(const MendedFiles& files, const InferOptions& options,
                                  const std::string& skeleton_path, const Image& image) {
  struct Result {
    const char *format, *ending, *start, *end;  // <stem><start>, a number, <end>: a drawing is none of them
  };
  constexpr Result kResults[] = {{"json", kSkeletonFileEnding, kEarlierSkeletonStart, kEarlierSkeletonEnd},
                                 {"silhouette", ".silhouette.png", ".old", ".silhouette.png"}};
  const std::string stem =
      skeleton_path.substr(0, skeleton_path.size() - std::string_view(kSkeletonFileEnding).size());
  std::vector<KeptFile> all;
  for (const Result& result : kResults) {
    const std::string path = stem + result.ending;
    if ((!writes(options, result.format) && !writes(options, "json")) || !contains(files.earlier, path))
      continue;
    const std::optional<SkeletonSource> source = sourceOfSkeleton(path);
    all.push_back({path, keepAs(path, stem + result.start, result.end),
                   source && source->image_width == image.width && source->image_height == image.height});
  }
  return all;
}

std::string keepContradicted(const MendedRig& mended, const InferOptions& options,
                             const std::string& skeleton_path) {
  if (mended.placed.contradicted.empty() || !mended.placed.labels_count || !writes(options, "json") ||
      mended.files.skeleton != skeleton_path)
    return "";
  const std::size_t stem = skeleton_path.size() - std::string_view(kSkeletonFileEnding).size();
  return keepAs(skeleton_path, skeleton_path.substr(0, stem) + kEarlierSkeletonStart, kEarlierSkeletonEnd);
}

std::optional<Note> keepPaintedLayers(const std::vector<std::string>& taken_up, MendedFiles& files,
                                      const InferOptions& options, const std::string& stem,
                                      const SkeletonFile& file) {
  const std::string start = options.out_dir + "/" + stem, path = start + ".layers.png";
  const std::optional<SkeletonSource> result = sourceOfSkeleton(start + kSkeletonFileEnding);
  const bool would_lose = writes(options, "layers") && !options.force;
  const bool would_revive = writes(options, "json") && !writes(options, "layers") && !isOfThis(result, file);
  std::error_code unknown;
  if ((!would_lose && !would_revive) || contains(taken_up, path) || !fs::is_regular_file(path, unknown))
    return std::nullopt;
  {
    const LookAtOutputs look;
    if (isAsSealed(readFile(path))) return std::nullopt;
  }
  std::erase(files.earlier, path);
  const auto name = [](const std::string& one) { return fs::path(one).filename().string(); };
  const std::string shared = "painted by hand, not taken up and kept",
                    what = name(path) + " (now " +
                           name(keepAs(path, start + kEarlierLayersStart, kEarlierLayersEnd)) + "), as " +
                           whyNotTakenUp(path, files, options, result, file);
  return Note{shared + ": " + what, shared, what};
}

std::optional<Note> keepModelOfOthers(const InferOptions& options, const std::string& stem) {
  const std::string start = options.out_dir + "/" + stem, path = start + ".glb";
  std::error_code unknown;
  if (!writes(options, "glb") || options.force || !fs::is_regular_file(path, unknown)) return std::nullopt;
  const std::string writer = generatorOfGlb(path);
  if (writer == ExportOptions().generator) return std::nullopt;
  const std::string shared = "a model that skel-infer did not write is kept",
                    what = fs::path(path).filename().string() + " is now " +
                           fs::path(keepAs(path, start + ".old", ".glb")).filename().string() +
                           (writer.empty() ? "" : " (by " + writer + ")");
  return Note{shared + ": " + what, shared, what};
}

}  // namespace skel
