// A photo that was taken again under its name: what a person had mended of the one before does not fit it.
// Skeletons, labels and masks that labels speak of say what they were made for; of other masks and of limbs
// the earlier result tells whether the picture has changed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "infer/mended.h"

namespace skel {

// Moves files that nobody named and that were made for another picture than the one of that hash from their
// place in `files` to `earlier`. `result`: what the earlier result, if there is one, was found in.
void leaveOutEarlier(MendedFiles& files, const InferOptions& options,
                     const std::optional<SkeletonSource>& result, const std::string& image_sha256);

// The same of a mask and of limbs that may have been there before the picture changed and have another size.
void leaveOutOtherSizes(MendedFiles& files, const Image& image);

// One sentence of each file that is taken up although it may show the picture before.
std::vector<const char*> warningsOfEarlier(const MendedFiles& files);

struct KeptFile {
  std::string was, is;  // paths
};

// Gives results that were left out another name before they are written over: <stem>.skeleton.old.json,
// <stem>.old.silhouette.png, or with a number where that is taken. Throws OutputError.
std::vector<KeptFile> keepEarlier(const MendedFiles& files, const InferOptions& options,
                                  const std::string& skeleton_path);

// Which files were left out; nothing where none was.
std::optional<Note> earlierNote(const MendedFiles& files, const std::vector<KeptFile>& kept);

}  // namespace skel
