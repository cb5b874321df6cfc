// A photo that was taken again under its name: what a person had mended of the one before does not fit it.
// Skeletons, labels and masks that labels speak of say what they were made for; of other masks and of limbs
// the earlier result tells whether the picture has changed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libskel/mended/mend_places.h"
#include "libskel/mended/mended_files.h"

namespace skel {

// What a skeleton that was made for an earlier picture is called from then on (numberedName()).
inline constexpr const char *kEarlierSkeletonStart = ".skeleton.old", *kEarlierSkeletonEnd = ".json";

// The same of painted layers.
inline constexpr const char *kEarlierLayersStart = ".old", *kEarlierLayersEnd = ".layers.png";

// The last one among those of the first of the places that has one of this very picture and figure; or "".
std::string earlierThatFits(const std::vector<MendPlace>& places, const MendRequest& request);

// Those of the first of the places that has any. Nothing tells of which picture they are.
std::vector<std::string> earlierLayers(const std::vector<MendPlace>& places);

// Moves labels, and the mask that they speak of, that nobody named and that were made for another picture
// than the request's from their place in `files` to `earlier`, and notes what may have been. `result`: what
// the earlier result, if there is one, was found in.
void leaveOutEarlier(MendedFiles& files, const MendRequest& request,
                     const std::optional<SkeletonSource>& result);

// The same of a mask and of limbs that nobody has named and that have another size than the picture, where an
// earlier run has left a result. Elsewhere whoever reads them says so.
void leaveOutOtherSizes(MendedFiles& files, const MendRequest& request, const Image& image);

// One sentence of each file that is taken up although it may show the picture before.
std::vector<const char*> warningsOfEarlier(const MendedFiles& files);

// A result that has another name now.
struct KeptFile {
  std::string was, is;        // paths
  bool may_be_named = false;  // a skeleton of a picture of this size
};

// Which files were left out, and which because of their size; nothing where none was.
std::optional<Note> earlierNote(const MendedFiles& files, const std::vector<KeptFile>& kept = {});
std::optional<Note> otherSizeNote(const MendedFiles& files, const std::vector<KeptFile>& kept = {});

// What to do to go back to a picture that was there before; nothing where there is no skeleton of it, or no
// layers that may be.
std::optional<Note> fitsAgainNote(const MendedFiles& files);
std::optional<Note> keptLayersNote(const MendedFiles& files, const MendRequest& request);

}  // namespace skel
