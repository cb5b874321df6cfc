// The folders in which what a person has mended of a drawing is looked for: one rule for all tools.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "libskel/skeleton/skeleton_file.h"

namespace skel {

struct MendRequest;

// As it is reached from the root, without links as far as it is there.
std::filesystem::path wholePath(const std::filesystem::path& path);

// Paths are without their endings.
struct MendPlace {
  std::string results;  // <results>.skeleton.json, .silhouette.png and .layers.png of the figure; "": none
  std::string made;     // <made>.mask.png, .labels.json, .limbs.png, .back.png
  std::optional<SkeletonSource> result;  // what the skeleton file, if there is one, was found in
  bool is_own = false;                   // where this run writes: it is of the drawing's name
  bool is_beside = false;                // the drawing's own folder
  bool is_of_picture = false;            // the result was found in the very picture that is asked for
  bool is_earlier = false;               // it was found in another one, which had the drawing's name
};

// In the order in which they count: where the run writes (request.results, if it does), beside the drawing,
// in out/ beside the drawing, in out/ of the working directory; each folder once. Elsewhere than where the
// run writes, only a result counts that names the picture, or the drawing. Throws InputError: a skeleton file
// of ours there cannot be read.
std::vector<MendPlace> mendPlaces(const MendRequest& request);

// What a person has made of a figure, without ending: `stem` of the first, <stem>-2 of the second.
std::string stemOfFigure(const std::string& stem, int figure);

// Below `folder`, where a run over a list keeps the folder of the drawing; nothing where it has none, is
// named from the root or leads out of where the run was made.
std::optional<std::filesystem::path> keptFolder(const std::string& folder, const std::string& drawing);

// Where a run of skel-infer with `-o folder` wrote what it has made of the figure of the drawing, without
// endings; of a list it keeps the folders. `folder`: "": nowhere, as the result. Throws InputError: no
// folder.
std::string resultsIn(const std::string& folder, const std::string& drawing, int figure);

}  // namespace skel
