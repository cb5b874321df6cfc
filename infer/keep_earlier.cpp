#include "infer/keep_earlier.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "infer/outputs.h"
#include "libskel/core/error.h"
#include "libskel/core/file_names.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

std::vector<KeptFile> keepEarlier(const MendedFiles& files, const InferOptions& options,
                                  const std::string& skeleton_path) {
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
    if (!writes(options, result.format) || !contains(files.earlier, path)) continue;
    const auto named = [&](int number) { return numberedName(stem + result.start, result.end, number); };
    std::string kept = named(1);
    std::error_code failure;
    for (int number = 2; fs::exists(fs::symlink_status(kept, failure)); ++number) kept = named(number);
    fs::rename(path, kept, failure);
    if (failure) throw OutputError(path, "cannot be kept as " + kept + ": " + failure.message());
    all.push_back({path, kept});
  }
  return all;
}

}  // namespace skel
