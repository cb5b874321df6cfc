// `<name>.clip.json`: a motion as a file that people may write by hand. The format is described in
// docs/formats.md.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "libskel/animation/clip.h"

namespace skel {

inline constexpr const char* kClipFileEnding = ".clip.json";

// Rotations as quaternions, or as angles to the thousandth of a degree where the clip has them.
// Throws Error by checkTimes() (clip_limits.h).
std::string formatClip(const Clip& clip);

// Keys that ease are given at kEasedRate_hz. Throws InputError that names file, JSON path and reason: times
// out of order or below 0, wrong counts, two tracks of one joint, what is no rotation.
Clip parseClip(std::string_view text, const std::string& file);
Clip readClipFile(const std::string& path);

inline constexpr double kEasedRate_hz = 30;

}  // namespace skel
