// Label files below a folder, as one set of samples.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "libskel/classifier/features.h"
#include "libskel/labels/annotated_image.h"
#include "libskel/labels/label_file.h"

namespace skel {

struct LabelledCharacter {
  std::string name;  // path of its label file below the folder, without the ending
  Features features;
  std::vector<JointClass> labels;  // one for each row
  std::string image_sha256 = {};   // of its picture; "": it has none
  std::string body_plan = {};      // whose joints its label file has; "": it has none, or others
};

struct LabelledSet {
  std::vector<LabelledCharacter> characters;  // sorted by name
  int unlabelled = 0;                         // candidates without a class, which are left out
  std::vector<std::string> without_class{};   // label files none of whose candidates has one: left out
  // Over names and bytes of all label files, which hold the hashes of their images and masks in turn.
  std::string sha256;

  int sampleCount() const;
  std::array<int, kJointClassCount> classCounts() const;
  // Sentences that say what was left out.
  std::vector<std::string> leftOut() const;
};

// What a net is to learn needs all four classes; what it is measured by does not. Throws InputError(name).
void ensureEveryClass(const std::string& name, const LabelledSet& set);

// Label files below `dir`, at any depth, sorted by path. Throws InputError: no such folder, one that
// cannot be read; OverwriteError: a skeleton file or joints file there is an output (noteSkeletonFiles()).
std::vector<std::string> findLabelFiles(const std::string& dir);

// "2 of 9 pictures have no labels (a.png, ...)": of those below `dir` that a person may have drawn, if `has`
// does not hold for some; else "".
std::string picturesWithout(const std::string& what, const std::string& dir,
                            const std::function<bool(const std::string& image)>& has);

// Every inconsistency of all label files below `dir`, one line each; none: all is well.
// Candidates without a label are not one: label files may be in the making.
std::vector<std::string> checkLabelFolder(const std::string& dir);

// Throws InputError that names file, JSON path and reason: whatever checkLabelFolder() finds, no label files
// at all, no candidate with a class. With `on_error` a drawing of which that is true is left
// out; what is thrown then is that none is left.
LabelledSet readLabelledSet(const std::string& dir, const OnInputError& on_error = {});

// The same with candidates of any method, labelled from the joints: of annotated pictures (see
// annotated_image.h), and of label files, in which only joints count that a person has placed. Candidates
// that may belong to a joint without a place have no class and are left out. Throws InputError, as above.
LabelledSet labelAnnotatedImages(const std::string& dir, const CandidateOptions& options = {},
                                 const OnInputError& on_error = {});

// Label files as readLabelledSet() reads them, and behind them annotated pictures that have none. Where there
// are no label files, labelAnnotatedImages(). `on_error`, as above, must be given.
LabelledSet readMeasuredSet(const std::string& dir, const OnInputError& on_error);

}  // namespace skel
