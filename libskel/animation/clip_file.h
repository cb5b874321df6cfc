// `<name>.clip.json`: a motion as a file that people may write by hand. The format is described in
// docs/formats.md.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "libskel/animation/clip.h"

namespace skel {

inline constexpr const char* kClipFileEnding = ".clip.json";

// The name of a file without its folder and that ending, or any other.
std::string clipNameIn(const std::string& path);

// Rotations as quaternions, or as angles to the thousandth of a degree where the clip has them.
// Throws Error by checkTimes() (clip_limits.h).
std::string formatClip(const Clip& clip);

// Keys that ease are given at kEasedRate_hz. Throws InputError that names file, JSON path and reason: times
// out of order or below 0, wrong counts, two tracks of one joint, what is no rotation.
Clip parseClip(std::string_view text, const std::string& file);
Clip readClipFile(const std::string& path);

inline constexpr double kEasedRate_hz = 30;

// How values go from key to key.
enum class KeyEase {
  kNone,  // straight, as the clip plays them
  kRest,  // they come to rest at each key: extremes of a motion
  kFlow,  // smoothly through the keys
  kLoop,  // the same, and from the last on as from the first, which is its equal
};

// What stands in a clip file, for who edits it: its keys, where parseClip() puts even ones for those that
// ease.
struct ClipKeys {
  Clip clip;
  KeyEase ease = KeyEase::kNone;

  bool operator==(const ClipKeys&) const = default;
};
std::string formatClipKeys(const ClipKeys& keys);
// Throws as parseClip().
ClipKeys parseClipKeys(std::string_view text, const std::string& file);
// The clip that plays, with even keys as parseClip() has them. Throws InputError: more than it takes.
Clip withEvenKeys(const ClipKeys& keys);

}  // namespace skel
