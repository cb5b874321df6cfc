// A figure of a drawing, rigged with all that a person has made for it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libskel/core/error.h"
#include "libskel/mended/mended_files.h"
#include "libskel/pipeline/rig_character.h"
#include "libskel/skeleton/skeleton_file.h"

namespace skel {

// The picture shows no figure.
struct NoFigureError : InputError {
  using InputError::InputError;
};

// The skeleton file that is handed in at `path`; nothing where that is "" or names labels. Throws InputError.
std::optional<SkeletonFile> givenSkeleton(const std::string& path, const RigOptions& rig);

// The number of its figure. Throws InputError if another than the first was asked for, which must be that
// one.
int figureOf(const SkeletonFile& given, const std::string& path, int asked);

struct MendedRig {
  RiggedDrawing drawing;
  LastStage last = LastStage::kClips;  // that it was taken to
  MendedFiles files;                   // that were taken up
  PlacedJoints placed;
  SkeletonFile::Mask mask;           // that was used, a path as given; "": none
  SkeletonFile::Mask limbs;          // SkeletonFile::limbs, the same
  std::optional<double> facing_deg;  // which way it looks, as a person has said
  std::string outline_sha256;        // of the figure
  std::string found_outline_sha256;  // where a mask was used and the run writes: SkeletonFile::foundOutline()
  std::vector<std::string> warnings;  // of the figure and its joints, a clause each
};

// `input`: the picture, or a model; `given`: of request.skeleton. Throws InputError: no figure, files of
// another picture or figure.
MendedRig rigMended(const MendRequest& request, const RigOptions& rig, RigInput input,
                    const std::optional<SkeletonFile>& given);

// What a person has made for the figure, taken up or left out; nothing of what a run keeps of its results.
std::vector<Note> mendedNotes(const MendedRig& rig, const MendRequest& request, const RigOptions& options);

bool hasPlacedJoint(const Skeleton& skeleton);

}  // namespace skel
