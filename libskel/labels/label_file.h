// `<stem>.labels.json`: the joint candidates of one picture and the class that each belongs to. The format is
// described in datasets/FORMAT.md.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "libskel/candidates/candidates.h"
#include "libskel/classifier/mlp.h"

namespace skel {

// Joints of a template by name, image px; nullopt: not visible in the picture.
using NamedJoints = std::vector<std::pair<std::string, std::optional<Eigen::Vector2d>>>;

struct LabelFile {
  struct Source {
    std::string file;    // in the folder of the label file
    std::string sha256;  // of its bytes when it was labelled
  };

  Source image;
  int image_width = 0, image_height = 0;   // px
  std::optional<Source> mask;              // given or mended by hand; else the figure is found in the image
  int grid_width = 0, grid_height = 0;     // of the working grid, px
  std::vector<JointCandidate> candidates;  // all maxima, in the order of CandidateSet::maxima
  std::vector<std::optional<JointClass>> labels;  // one for each candidate; nullopt: not yet labelled
  NamedJoints joints;                             // empty: not known
  std::vector<std::string> recognized;            // those of `joints` that no person has placed

  int gridSize() const { return std::max(grid_width, grid_height); }
  // Whether a person has placed the joint of that name, or any.
  bool isPlaced(const std::string& joint) const;
  bool hasPlacedJoint() const;
  // As `skel-label candidates` makes them: no person has placed, painted or labelled anything.
  bool isBlank() const;
};

inline constexpr const char* kLabelFileEnding = ".labels.json";
inline bool isLabelFile(std::string_view path) { return path.ends_with(kLabelFileEnding); }
// "dir/knight.png" → "dir/knight.labels.json".
std::string labelFileFor(const std::string& image);

// Throws InputError with the first of findProblems' complaints that lie in the file itself.
LabelFile readLabelFile(const std::string& path);
// LabelFile::isBlank(). False of one that cannot be read, which may hold anything.
bool isBlankLabelFile(const std::string& path);
// The same labels give the same bytes.
std::string formatLabelFile(const LabelFile& labels);
// At any moment `path` holds the old labels or the new ones. Throws OutputError.
void writeLabelFile(const std::string& path, const LabelFile& labels);

// Everything that is wrong with a label file, with file and JSON path, one line for all that is wrong in the
// same way: what readLabelFile() refuses, and an image or a mask that is missing or has changed since it was
// labelled, or a mask beside the picture that it does not name.
std::vector<std::string> findProblems(const std::string& path);

// Throws InputError: the image or the mask is missing, or has changed since it was labelled.
void ensureUnchanged(const std::string& path, const LabelFile& labels);

// Of the image or mask, as a path that can be opened.
std::string besideLabelFile(const std::string& label_file, const std::string& name);

// A mask that a person has left beside a picture: <stem>.mask.png, or mask.png beside image.png.
std::optional<std::string> maskBeside(const std::string& image);

// The mask that the label file names, or else the one beside its picture.
std::optional<std::string> maskOf(const std::string& label_file, const LabelFile& labels);

}  // namespace skel
