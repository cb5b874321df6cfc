// What a person should know of joints that were found, or not.
#pragma once

#include <string>
#include <vector>

#include "libskel/recognition/recognition.h"

namespace skel {

// Likeness below which it is said that this is hardly a figure of the body plan.
inline constexpr double kHardlyOne = 0.5;

// A joint is named that is wrong in more than one of three cases, by its confidence.
inline constexpr double kSureJoint = 2. / 3;

// Joints that were found and are below that.
std::vector<std::string> unsureJoints(const Recognition& recognition);

// Of joints that were not found; "": all were.
std::string missingNote(const std::vector<std::string>& missing);

// Where that is not all.
std::string doubtNote(const std::vector<std::string>& missing);

// Of all; "": nothing.
std::string jointNote(const Recognition& recognition, const std::string& body_plan);

}  // namespace skel
