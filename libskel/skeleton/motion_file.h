// `<stem>.motion.json`: where the joints of a character are in the (key) frames of a video. The format is
// described in docs/formats.md.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "libskel/skeleton/skeleton.h"
#include "libskel/skeleton/template.h"

namespace skel {

struct PlacedJoint {
  Eigen::Vector2d image = Eigen::Vector2d::Zero();  // image px
  double confidence = 0;                            // [0, 1]
  JointOrigin origin = JointOrigin::kEdited;

  bool operator==(const PlacedJoint&) const = default;
};

struct MotionFrame {
  std::string image_file;                          // a path relative to the motion file; empty: no picture
  int image_width = 0, image_height = 0;           // px
  double time_s = 0;                               // in the video, later than that of the frame before
  std::vector<std::optional<PlacedJoint>> joints;  // one a joint of the template; nullopt: not known
  bool key = false;                                // one of the frames that tell most of the motion
};

struct MotionFile {
  double frame_rate = 0;            // of the video, 1/s; in [kMinFrameRate, kMaxFrameRate]
  std::vector<MotionFrame> frames;  // at least one
  std::string source;               // where the motion is from, for people: a video, "A in the style of B"
  std::string action;               // its class: walk, run, jump ...; empty: none
};

inline constexpr const char* kMotionFileEnding = ".motion.json";
inline constexpr int kLongestMotionSide_px = 1'000'000;  // of a frame
inline constexpr double kMinFrameRate = 0.001, kMaxFrameRate = 1000;

// Version 1 where that holds all, as older programs read it. Places to the hundredth of a pixel, confidences
// and times to the thousandth and the millionth.
std::string formatMotionFile(const MotionFile& motion, const SkeletonTemplate& body_plan);

// Throws InputError that names file, JSON path and reason: another template, joints that it does not have,
// twice the same joint, one outside its image, times that do not increase, no frame at all.
MotionFile readMotionFile(const std::string& path, const SkeletonTemplate& body_plan);

// The name of the template that a motion file belongs to. Throws InputError: no motion file.
std::string templateOfMotion(const std::string& path);

// Before a motion file is written anew: throws InputError if there is one at `path` that holds joints which a
// person has placed.
void requireNoEdits(const std::string& path, const SkeletonTemplate& body_plan);

}  // namespace skel
