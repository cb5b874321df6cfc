// A photo that was taken again under its name: what a person had mended of the one before is kept.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "infer/infer_options.h"
#include "libskel/mended/earlier_picture.h"

namespace skel {

// Gives results that were left out another name before they are written over: <stem>.skeleton.old.json,
// <stem>.old.silhouette.png, or with a number where that is taken. `image`: the one of now. Throws
// OutputError.
std::vector<KeptFile> keepEarlier(const MendedFiles& files, const InferOptions& options,
                                  const std::string& skeleton_path, const Image& image);

// The same for layers that a person has painted and that this run has not taken up, where it writes others:
// <stem>.old.layers.png, or with a number. `taken_up`: paths that stay. With --force nothing is kept.
std::optional<Note> keepPaintedLayers(const std::vector<std::string>& taken_up, const MendedFiles& files,
                                      const InferOptions& options, const std::string& stem);

}  // namespace skel
