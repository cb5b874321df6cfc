// Skeletons that come with a model of the user's own:
//   {"joints": [{"name", "index", "head": [x, y, z], "tail": [x, y, z], "parent"}], "hierarchy": {child:
//   parent}}
#pragma once

#include <string>

#include "libskel/skeleton/skeleton.h"

namespace skel {

// Positions in the file's own frame. `hierarchy` may be missing; where it is there, it may name one joint
// that `joints` does not list: the root, which stands at the origin and moves no bone. Throws InputError with
// the JSON path: a joint that is its own ancestor, two of one name, a parent that there is not, two roots,
// parents that disagree. Other keys are left alone; `note` (or null) says which, and is empty where there are
// none.
Skeleton readRigFile(const std::string& path, std::string* note = nullptr);

// More are read from no file: what looks at all pairs of them stays quick.
inline constexpr std::size_t kMostJoints = 4096;

// Whether the JSON file at `path` is one of skel's own (has a "format"), not such a one. Throws InputError.
bool isSkelFile(const std::string& path);

}  // namespace skel
