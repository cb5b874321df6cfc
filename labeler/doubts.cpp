#include "labeler/doubts.h"

#include <algorithm>
#include <filesystem>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/sha256.h"
#include "libskel/mended/mend_places.h"
#include "libskel/mended/mended_files.h"

namespace skel {
namespace fs = std::filesystem;
namespace {

bool isMendedSince(const DrawingFiles& files, const std::string& result) {
  std::error_code not_there;
  const auto made = fs::last_write_time(result, not_there);
  for (const std::string& file : {files.labels, files.mask, layersFile(files, 1)}) {
    const auto mended = fs::last_write_time(file, not_there);
    if (!not_there && mended > made) return true;
  }
  return false;
}

}  // namespace

std::vector<std::string> doubtsOf(const DrawingFiles& files) {
  try {
    MendRequest request;
    request.source = files.image;
    const std::vector<MendPlace> places = mendPlaces(request);
    const auto found = std::find_if(places.begin(), places.end(),
                                    [](const MendPlace& place) { return place.result.has_value(); });
    if (found == places.end() || found->result->image_sha256 != sha256(readFile(files.image)) ||
        isMendedSince(files, found->results + kSkeletonFileEnding))
      return {};
    return found->result->warnings;
  } catch (const InputError&) {
  }
  return {};
}

}  // namespace skel
