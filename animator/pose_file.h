// `<name>.pose.json`: one pose of a character.
#pragma once

#include <string>

#include "libskel/animation/sample_pose.h"

namespace skel {

inline constexpr const char* kPoseFileEnding = ".pose.json";

// {"format": "skel-pose", "version": 1, "root_translation": [x, y, z], "joints": {name: {"rotation": [x, y,
// z, w], "translation_m": [x, y, z], "scale": [x, y, z]}}}; what is as in the rest pose is left out.
std::string formatPose(const Pose& pose, const Skeleton& skeleton);

// Throws InputError with the JSON path: a joint that the skeleton lacks, what is no rotation.
Pose parsePose(std::string_view text, const std::string& file, const Skeleton& skeleton);

// Whether `text` says that it is a pose.
bool isPoseFile(std::string_view text);

// A motion of one key, relative to the rest pose.
Clip clipOfPose(const Pose& pose, const Skeleton& skeleton, const std::string& name);

}  // namespace skel
