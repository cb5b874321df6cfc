// What a person has mended and a run does not take up is kept: of a photo that was taken again under its
// name, and joints that were placed elsewhere later.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "infer/infer_options.h"
#include "libskel/mended/earlier_picture.h"
#include "libskel/mended/rig_mended.h"

namespace skel {

// Gives results that were left out another name before they are written over, or a new skeleton file beside
// them makes them this picture's: <stem>.skeleton.old.json, <stem>.old.silhouette.png, or with a number where
// that is taken. `image`: the one of now. Throws OutputError.
std::vector<KeptFile> keepEarlier(const MendedFiles& files, const InferOptions& options,
                                  const std::string& skeleton_path, const Image& image);

// The same for layers that a person has painted and that this run has not taken up: <stem>.old.layers.png, or
// with a number; they are no longer among files.earlier. Before keepEarlier(). `taken_up`: paths that stay;
// `file`: that the run writes. With --force layers that are written over are not kept.
std::optional<Note> keepPaintedLayers(const std::vector<std::string>& taken_up, MendedFiles& files,
                                      const InferOptions& options, const std::string& stem,
                                      const SkeletonFile& file);

// The same for a model that others have written, as the window of skel-animate does with its clips:
// <stem>.old.glb, or with a number. Not with --force.
std::optional<Note> keepModelOfOthers(const InferOptions& options, const std::string& stem);

// The same for a skeleton that this run writes over and whose joints lose against those of labels that were
// placed later. Returns what it is called now; "": nothing was kept.
std::string keepContradicted(const MendedRig& mended, const InferOptions& options,
                             const std::string& skeleton_path);

}  // namespace skel
