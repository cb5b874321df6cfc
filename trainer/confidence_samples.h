// What the recognition finds in drawings with known joints, as they are and disturbed, and whether it is
// right: what confidence is learned from.
#pragma once

#include <string>
#include <vector>

#include "libskel/jointnet/joint_net.h"
#include "libskel/recognition/evidence.h"
#include "trainer/jointed_drawing.h"

namespace skel {

// What was done to a drawing.
enum class Disturbance {
  kNone,       // by its mask
  kFound,      // the silhouette is found in the picture; of pictures without transparency
  kWarped,     // other proportions, leaning
  kTurned,     // by any angle
  kThing,      // pieces of another drawing are stuck to it
  kLimb,       // a hand or foot is missing, with some of what bears it
  kBite,       // the mask lacks pieces, or has blots of ground
  kCut,        // a good part of the figure lies outside the picture: no whole figure
  kPair,       // another figure is stuck to it: no whole figure
  kOtherPlan,  // a figure of another body plan
};
inline constexpr int kDisturbances = 10;

struct ConfidenceSample {
  std::string drawing;  // drawingName() of its picture
  Disturbance disturbance = Disturbance::kNone;
  std::string body_plan;  // that was looked for
  Evidence evidence;
  std::vector<double> masses;  // by joint: TreeJoint::mass
  double likeness = 0;         // TreeRecognition::likeness
  std::vector<int> right;      // by joint: 1 within 10 % of the figure's long side, 0 farther off, -1 unknown
  bool usable = false;         // a whole figure of the body plan, every known joint within 15 %
};

std::string drawingName(const std::string& picture);  // the file's name without its ending

// One sample of each kind of disturbance a drawing where that can be, `copies` of each that is random. Of
// `others`, drawings of other body plans, kOtherPlan alone. The same for the same seed, whatever the threads.
std::vector<ConfidenceSample> confidenceSamples(const std::vector<JointedDrawing>& drawings,
                                                const std::vector<JointedDrawing>& others,
                                                const JointNet& net, int copies, std::uint64_t seed,
                                                int threads);

}  // namespace skel
