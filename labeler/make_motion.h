// Motion files from the frames of a video.
#pragma once

#include <string>

#include "labeler/import_labels.h"
#include "libskel/classifier/mlp.h"
#include "libskel/pipeline/rig_character.h"
#include "libskel/skeleton/body_plans.h"

namespace skel {

struct MotionOptions {
  std::string output;      // empty: out/<name of the folder>.motion.json
  double frame_rate = 12;  // of the frames, 1/s
  bool force = false;      // also over joints that were placed by hand
  Mlp mlp;
  BodyPlans body_plans;  // of most frames
  Recognizer recognizer = Recognizer::kTree;
};

struct MotionCounts {
  std::string output;
  int frames = 0;
  int without_figure = 0;  // their joints are left open
};

// Recognises the joints in each picture below `dir`, in the order of their names ("frame 9" before
// "frame 10"), with the mask beside it if there is one. `on_note` is told the picture and the reason where no
// figure is found. Throws InputError: no picture, one that cannot be read, no figure in any of them, joints
// placed by hand in the file that is there already; OutputError.
MotionCounts makeMotion(const std::string& dir, const MotionOptions& options, const OnError& on_note);

}  // namespace skel
