// Clip files of the elk system: `{"name", "duration", "keyframes": {joint: [{"time", "rotation": [x, y, z],
// "translation", "scale"}]}}`, described in docs/formats.md.
#pragma once

#include <string>
#include <string_view>

#include "libskel/animation/clip.h"

namespace skel {

struct KeyframeClipOptions {
  bool z_up = false;  // the file's axes: (x, y, z) is (x, z, −y) of ours
  RotationInterpolation interpolation = RotationInterpolation::kSlerp;
};

// Rotations are angles in radians, R = Rz · Ry · Rx; a key may lack any of the three. Throws InputError that
// names file, JSON path and reason: a key for a joint that `skeleton` lacks, times out of order, a number
// that is none.
// Other keys are left alone; `note` (or null) says which, and is empty where there are none.
Clip readKeyframeClip(const std::string& path, const Skeleton& skeleton,
                      const KeyframeClipOptions& options = {});
Clip parseKeyframeClip(std::string_view text, const std::string& file, const Skeleton& skeleton,
                       const KeyframeClipOptions& options = {}, std::string* note = nullptr);

// Whether the text is JSON that looks like such a file.
bool isKeyframeClip(std::string_view text);

}  // namespace skel
