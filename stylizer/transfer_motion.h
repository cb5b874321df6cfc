// Motion files in, a motion file out: style transfer between them.
#pragma once

#include <string>
#include <vector>

#include "libskel/style/transfer.h"
#include "stylizer/database.h"

namespace skel {

enum class MirrorStyle { kAutomatic, kNever, kAlways };

struct MotionTransferOptions {
  TransferOptions transfer;
  MirrorStyle mirror = MirrorStyle::kAutomatic;  // automatic: where the two look to different sides
  std::string loop = "auto";                     // auto, yes, no: of both motions
  bool by_signatures = false;                    // match components by classes instead of phases
};

struct MotionTransferReport {
  MotionFile motion;  // without pictures
  double error = 0;   // of the factorisation
  bool content_loops = false, style_loops = false, mirrored = false;
  double phase_correlation = 0;  // of the distance between the feet, over time, with the content's
  bool steps = false;            // in both the feet come apart and together as in a walk, which few dances do
  double mean_pose_moved = 0;    // share of the way from the content's mean bone directions to the style's
  // Last joints of limbs that move, seen from the first, less than a quarter as far as in the content and as
  // in the style.
  std::vector<std::string> still;
};

// What whoever looks at the new motion should know, a sentence each: feet out of step, limbs that stay.
std::vector<std::string> transferNotes(const MotionTransferReport& report);

// The first content motion in the style of the style's motions of the same class (all of them where neither
// has classes). Further motions of both, of other classes, join the factorisation. Throws InputError: no
// class that both show, joints that no frame knows.
MotionTransferReport transferMotion(const std::vector<NamedMotion>& content,
                                    const std::vector<NamedMotion>& style,
                                    const MotionTransferOptions& options = {});

}  // namespace skel
