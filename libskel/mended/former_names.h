// A picture that got another name, or another folder, after it was mended: label and skeleton files tell by
// its hash that they are its.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "libskel/mended/mend_places.h"

namespace skel {

// Looks into each folder once, when it is first asked about. Several threads may ask.
class FormerNames {
 public:
  // Skeleton files in `folder`, and label files beside which no picture of their name lies, of the first
  // 10,000 of these, that have that hash somewhere in them. In natural order.
  std::vector<std::string> filesWith(const std::string& sha256, const std::filesystem::path& folder);
  // Whether one of them is a label file.
  bool hasLabelsAlone(const std::filesystem::path& folder);

 private:
  struct Folder {
    std::multimap<std::string, std::string> by_hash;
    bool labels_alone = false;
  };
  const Folder& lookInto(const std::filesystem::path& folder);

  std::mutex mutex_;
  std::map<std::filesystem::path, Folder> folders_;
};

// A place under a name that the picture had: with a result, labels, or both.
struct FormerPlace {
  MendPlace place;     // is_of_picture
  std::string labels;  // of this picture; ""
  std::string name;    // of the picture then
};

// Those whose picture is gone under that name, or is this one: in the folders of mendPlaces(), `places`, and
// below request.out_dir, where a run that named its drawings otherwise may have written. Of a folder those
// that were written last come first.
std::vector<FormerPlace> formerPlaces(const MendRequest& request, const std::vector<MendPlace>& places);

// A label file beside the drawing of that hash, made when it was called otherwise, and not blank; "": none.
std::string formerLabels(const std::string& drawing, const std::string& image_sha256, FormerNames& names);

}  // namespace skel
