// From a film to a motion: the joints of the figure in every frame.
#pragma once

#include <string>
#include <vector>

#include "libskel/skeleton/motion_file.h"
#include "libskel/style/track_joints.h"
#include "stylizer/film_figure.h"

namespace skel {

struct KeypointOptions {
  FilmSource film;
  std::string output;         // the motion file; pictures of a film's frames go beside it
  std::string action;         // its class
  std::string loop = "auto";  // auto, yes, no: whether the first frame follows the last
  double threshold = 0.5;     // of key frames (outline_distance.h)
  TrackOptions track;
};

// The motion's source: the film's name without its folder.
std::string filmName(const std::string& path);

struct Keypoints {
  MotionFile motion;
  int without_figure = 0;      // frames
  double unevenness_seen = 0;  // unevenness() as recognised, and as written
  double unevenness = 0;
  int arms_swapped = 0, legs_swapped = 0;  // frames whose limbs got the names of the other side
  bool loop = false;
  std::string other_plan;  // whose figure most frames that were asked show, where it is no biped's
};

// On stderr, where the film shows another body plan's figure.
void sayOtherPlan(const Keypoints& found, const std::string& film);

// On stderr, where the frames lie in a folder and nobody has said how many a second they are.
void sayAssumedRate(const FilmSource& film);
// The same, where somebody has said it of a film, which says so itself.
void sayUnusedRate(const FilmSource& film);

// Recognition of each frame (rigCharacter()), one path through all of them (track_joints.h), key frames by
// the outlines. The frames of a film are written as pictures to `<stem>.frames/`. Throws InputError: no
// figure in any frame; OutputError.
Keypoints findKeypoints(const KeypointOptions& options);

}  // namespace skel
