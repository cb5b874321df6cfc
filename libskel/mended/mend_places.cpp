#include "libskel/mended/mend_places.h"

#include <algorithm>
#include <filesystem>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/mended/mended_files.h"

namespace skel {
namespace fs = std::filesystem;

fs::path wholePath(const fs::path& path) {
  std::error_code unknown;
  return fs::weakly_canonical(fs::absolute(path.empty() ? "." : path, unknown), unknown);
}

namespace {

// By its path, or by its name where results were moved and the path leads nowhere.
bool isOfDrawing(const SkeletonSource& result, const std::string& results, const std::string& drawing) {
  std::error_code not_there;
  const fs::path named = fs::path(results).parent_path() / result.image_file;
  if (fs::exists(named, not_there)) return fs::equivalent(named, drawing, not_there);
  return named.filename() == fs::path(drawing).filename();
}

void judge(MendPlace& place, const MendRequest& request) {
  if (!place.result) return;
  const bool knows_picture = !place.result->image_sha256.empty();
  const bool of_drawing = place.is_own || isOfDrawing(*place.result, place.results, request.source);
  place.is_of_picture = knows_picture ? request.isOfPicture(place.result->image_sha256) : of_drawing;
  place.is_earlier = of_drawing && !place.is_of_picture;
}

// One of ours in which somebody has broken something is not passed over; others' files may have that name.
std::optional<SkeletonSource> resultAt(const std::string& path) {
  std::optional<SkeletonSource> result = sourceOfSkeleton(path);
  std::error_code unknown;
  const LookAtOutputs look;
  if (!result && fs::is_regular_file(path, unknown) &&
      readFile(path).find("\"skel-skeleton\"") != std::string::npos)
    return readSkeletonSource(path);
  return result;
}

// With a number if all figures were rigged. Not where the run writes.
MendPlace placeIn(const fs::path& folder, const MendRequest& request) {
  MendPlace place;
  place.made = (folder / fs::path(request.source).stem()).string();
  for (const std::string& number : {std::string(), "-" + std::to_string(request.figure)}) {
    MendPlace numbered = place;
    numbered.results = place.made + number;
    if (!request.results.empty() && wholePath(numbered.results) == wholePath(request.results)) continue;
    numbered.result = resultAt(numbered.results + kSkeletonFileEnding);
    if (!numbered.result || numbered.result->number != request.figure) continue;
    judge(numbered, request);
    if (numbered.is_of_picture || numbered.is_earlier) return numbered;
  }
  return place;
}

}  // namespace

std::vector<MendPlace> mendPlaces(const MendRequest& request) {
  std::vector<MendPlace> places;
  std::vector<fs::path> seen;
  const fs::path beside = fs::path(request.source).parent_path();
  if (!request.results.empty()) {
    const fs::path folder = fs::path(request.results).parent_path();
    MendPlace own;
    own.results = request.results;
    own.made = (folder / fs::path(request.source).stem()).string();
    own.result = sourceOfSkeleton(request.results + kSkeletonFileEnding);
    own.is_own = true;
    judge(own, request);
    places.push_back(own);
  }
  for (const fs::path& folder : {beside, beside / "out", fs::path("out")}) {
    const fs::path path = wholePath(folder);
    if (std::find(seen.begin(), seen.end(), path) != seen.end()) continue;
    seen.push_back(path);
    places.push_back(placeIn(folder, request));
  }
  for (MendPlace& place : places)
    place.is_beside = wholePath(fs::path(place.made).parent_path()) == wholePath(beside);
  return places;
}

std::string stemOfFigure(const std::string& stem, int figure) {
  return figure == 1 ? stem : stem + "-" + std::to_string(figure);
}

std::optional<fs::path> keptFolder(const std::string& folder, const std::string& drawing) {
  const fs::path name = fs::path(drawing).lexically_normal();
  if (!name.has_parent_path() || !name.is_relative() || *name.begin() == "..") return std::nullopt;
  return folder / name.parent_path();
}

std::string resultsIn(const std::string& folder, const std::string& drawing, int figure) {
  if (folder.empty()) return "";
  if (std::error_code unknown; !fs::is_directory(folder, unknown)) throw InputError(folder, "is no folder");
  const fs::path name = fs::path(drawing).lexically_normal();
  const std::string results = (folder / name.stem()).string(), number = "-" + std::to_string(figure);
  std::vector<std::string> places = {results};
  if (const auto kept = keptFolder(folder, drawing)) places.push_back((*kept / name.stem()).string());
  for (const std::string& place : places)
    for (const std::string& one : {place, place + number})
      if (const auto found = sourceOfSkeleton(one + kSkeletonFileEnding); found && found->number == figure)
        return one;
  return figure == 1 ? results : results + number;
}

}  // namespace skel
