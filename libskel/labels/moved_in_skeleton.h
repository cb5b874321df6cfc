// A label file, and the skeleton file beside its picture in which a person has placed joints elsewhere: one
// that was mended after it had been imported.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libskel/labels/label_file.h"

namespace skel {

struct MovedInSkeleton {
  std::string file;                 // <stem>.skeleton.json
  std::vector<std::string> joints;  // that it has from a person, not from labels, and these labels have not
};

// Nothing where there is no such joint, or no skeleton file of this very picture and its first figure.
std::optional<MovedInSkeleton> movedInSkeleton(const std::string& label_file, const LabelFile& labels);

// Joints that count as found, but lie elsewhere than the skeleton file beside has found them: somebody has
// moved them in the label file. None where most lie elsewhere: the labels were not found with it.
std::vector<std::string> movedButRecognized(const std::string& label_file, const LabelFile& labels);

// One line about skeleton files that do not count for that.
std::string movedInSkeletonNote(const std::vector<std::string>& skeleton_files);

}  // namespace skel
