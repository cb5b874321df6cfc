// Label files from annotations that others have made, and empty ones.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "libskel/core/error.h"
#include "libskel/skeleton/body_plans.h"

namespace skel {

struct ImportOptions {
  std::string
      output;  // folder that pictures and masks are copied to; empty: label files go beside the pictures
  // Make label files anew that exist already, also over masks and copies that are there. Classes that were
  // set by hand stay where the candidate is still there.
  bool force = false;
};

struct ImportCounts {
  int made = 0;
  int kept = 0;                         // there was a label file already
  std::vector<std::string> differing;   // of those kept: whose joints are not those of the annotation
  std::vector<std::string> earlier;     // of those kept: made for another picture than the one that is there
  std::vector<std::string> other_mask;  // of those kept: made by another mask than the one that is there
  int failed = 0;
  int joints_placed = 0, joints_found = 0;  // in those made: by a person, by the program
  int labelled = 0;      // label files without any class whose candidates got theirs by their placed joints
  int masks_taken = 0;   // label files made anew by a mask beside their picture, without an annotation
  int classes_kept = 0;  // in those made: of a label file before, set by hand
  int classes_dropped = 0;  // of candidates that are no longer there, where the nearest has another class
  std::vector<std::string> lacking;      // of those made: without a place for some joint
  std::set<std::string> missing_joints;  // of these
  std::size_t without_class = 0;         // candidates of these
  std::map<std::string, std::set<std::string>> unknown_joints;  // by annotation: names of none that is known
  std::vector<std::string> outside_mask;                        // of those made: jointsOutsideMask(), or
                                                                // jointFarOutsideFigure()
  std::map<JointClass, std::vector<std::string>> without_limb;  // of those made: classWithoutCandidate()
  std::vector<std::string> former;                              // of those made: as which file, in a sentence
  std::set<std::string> passed_over;     // files that we have exported, beside what they were made of
  std::set<std::string> folders;         // that those made lie in
  ExitCode exit_code = ExitCode::kDone;  // of the first failure
};

// Is told the error of every drawing that could not be used; the others are still processed.
using OnError = std::function<void(const Error&)>;

// `path`: a folder (see findAnnotatedDrawings() for what is read), or a COCO file. Candidates of label files
// in the folder of which a person has placed joints, and that have no class at all, get theirs by them.
// Throws InputError where there is nothing to import.
ImportCounts importLabels(const std::string& path, const BodyPlans& plans, const ImportOptions& options,
                          const OnError& on_error);

// A label file without labels for every drawing below `dir` that has none, with those that were made when it
// had another name where there are such.
ImportCounts makeLabelFiles(const std::string& dir, const OnError& on_error);

}  // namespace skel
