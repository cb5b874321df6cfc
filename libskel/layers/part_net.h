// A convolutional net that says which part of a figure each of its pixels is: trunk, head, a limb, a skirt, a
// thing held. It sees the figure's colours and where its bones lie, so that it need not tell left from right
// nor arms from front legs. Trained on generated figures and on drawings (skel-train parts).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "libskel/convnet/conv_net.h"
#include "libskel/skeleton/template.h"

namespace cv {
class Mat;
}

namespace skel {

enum class Part : std::uint8_t {
  kTrunk,
  kHead,
  kHair,      // or a beard, where it hangs below the chin
  kRightArm,  // or front leg
  kLeftArm,
  kRightLeg,  // or hind leg
  kLeftLeg,
  kSkirt,     // or the tails of a coat
  kAppendix,  // cape, wing, tail
  kThing,     // held or worn
};
inline constexpr int kPartCount = 10;
// The part that is limb 0…3 of a body plan.
inline constexpr Part limbPart(int limb) {
  return static_cast<Part>(static_cast<int>(Part::kRightArm) + limb);
}

// The net looks at a figure whose long side has this many px, in the upper left of a square; its input map
// has 2×2 px of that in each of its pixels, and so has its output map.
inline constexpr int kPartNetSize = 160;
inline constexpr int kPartMapSize = kPartNetSize / 2;
inline constexpr int kPartInputChannels = 32, kPartOutputChannels = 48;

struct PartNet : ConvNet {
  std::string provenance;  // how the weights came to be, for people
};

// The joints that the net is told. Any unit, the corner of the first px at 0.
struct PartSkeleton {
  Eigen::Vector2d head, body;
  std::array<std::array<Eigen::Vector2d, 3>, 4> limbs;  // of the template, from the trunk outwards
  bool animal = false;                                  // goes on four feet; has a tail
  Eigen::Vector2d tail_root = Eigen::Vector2d::Zero(), tail = Eigen::Vector2d::Zero();

  Eigen::Vector2d neck() const { return (limbs[0][0] + limbs[1][0]) / 2; }
  Eigen::Vector2d pelvis() const { return (limbs[2][0] + limbs[3][0]) / 2; }
};
// Whether the net can be asked about figures of this body plan: four limbs of three joints.
bool knowsParts(const SkeletonTemplate& body_plan);

// With all parameters zero.
PartNet makePartNet();
// Fills the input map. `rgb` (CV_8UC3), `mask` (CV_8U, not 0 on the figure): at most kPartNetSize px wide and
// high; `skeleton` in px of them.
void encodeParts(const cv::Mat& rgb, const cv::Mat& mask, const PartSkeleton& skeleton,
                 std::vector<float>& input);
// Where in the output map the logit of part `k` of px (x, y) lies; k = kPartCount: the log-odds that the limb
// which the px is of lies before what it overlaps.
inline constexpr std::size_t partLogitIndex(int y, int x, int k) {
  return static_cast<std::size_t>(paddedIndex(kPartMapSize, y / 2, x / 2)) * kPartOutputChannels +
         static_cast<std::size_t>(12 * (2 * (y % 2) + x % 2) + k);
}

// One line of JSON (format, version, provenance, SHA-256 of what follows), then the weights
// (formatWeights()). Throws InputError.
PartNet parsePartNet(std::string_view bytes, const std::string& file, bool check_hash = true);
std::string formatPartNet(const PartNet& net);
// The net that is compiled in. Throws UsageError where the build leaves it out (SKEL_NETS).
const PartNet& builtInPartNet();

}  // namespace skel
