// A small convolutional net that sees a whole silhouette and says where the joints are: one heatmap a joint.
// Trained on
// generated figures and on our own drawings in other poses (skel-train joints).
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "libskel/convnet/conv_net.h"
#include "libskel/image/image.h"
#include "libskel/jointnet/figure_look.h"

namespace skel {

// The net looks at a square frame of kFrameSize px of the working grid, the figure's box in its middle, at
// half the resolution; its heatmaps have a quarter of it.
inline constexpr int kFrameSize = 144;
inline constexpr int kNetInputSize = kFrameSize / 2;
inline constexpr int kNetInputChannels = 32;
// Nets of former versions of the program, which are still read, have these and are narrower.
inline constexpr int kCoarseInputChannels = 16, kColourlessInputChannels = 8;
inline constexpr int kHeatmapSize = kFrameSize / 4;
inline constexpr int kMaxNetJoints = 63, kMaxHourglasses = 8;
// One a joint, one for the figure; the kernels want multiples of 16, so the others are idle.
constexpr int heatmapChannels(int joints) { return (joints + 1 + 15) / 16 * 16; }

// How long the bones are that lead to a joint from the next one on the way to the body, in drawings: of the
// logarithm of 1 + the length, in px of a figure whose long side is 128; and of its difference to that of the
// bone before. A deviation of 0: not known.
struct BoneLength {
  double mean = 0, deviation = 0, ratio_mean = 0, ratio_deviation = 0;
  static double logOf(double length_px) { return std::log(1 + length_px); }
};

struct JointNet : ConvNet {
  std::string body_plan;            // name of the template that it was trained for
  std::vector<std::string> joints;  // of the heatmaps, at most kMaxNetJoints
  std::string provenance;           // how the weights came to be, for people
  int hourglasses = 1;              // one behind another
  std::vector<BoneLength> bones;    // by joint; empty: not known

  // The channel after the joints': its mean is the log-odds of one whole upright figure of the body plan.
  int figureChannel() const { return static_cast<int>(joints.size()); }
};

// The architecture with all parameters zero, for at most kMaxNetJoints joints. A net of kCoarseInputChannels
// sees lines and colours at half the resolution, one of kColourlessInputChannels silhouette and lines alone.
JointNet makeJointNet(std::string body_plan, std::vector<std::string> joints, int hourglasses = 1,
                      int input_channels = kNetInputChannels);

// Where a figure lies in the net's frame: frame px = grid px + offset, mirrored about the frame's middle
// after that if `mirrored`.
struct FramePlacement {
  int offset_x = 0, offset_y = 0;
  bool mirrored = false;

  // An odd figure lies half a px left of the middle, before it is mirrored half a px right of it: the figure
  // and its mirror image then have the same two inputs.
  static FramePlacement centred(const Plane8& mask, bool mirrored = false);
  Eigen::Vector2d frameFromGrid(const Eigen::Vector2d& p) const {
    const double x = p.x() + offset_x;
    return {mirrored ? kFrameSize - 1 - x : x, p.y() + offset_y};
  }
  Eigen::Vector2d gridFromFrame(const Eigen::Vector2d& p) const {
    return {(mirrored ? kFrameSize - 1 - p.x() : p.x()) - offset_x, p.y() - offset_y};
  }
};
// Heatmap cells cover 4×4 frame px.
inline Eigen::Vector2d cellFromFrame(const Eigen::Vector2d& p) { return ((p.array() - 1.5) / 4).matrix(); }
inline Eigen::Vector2d frameFromCell(const Eigen::Vector2d& p) { return (p.array() * 4 + 1.5).matrix(); }

// Fills the net's input map, of so many channels. `mask` (at most kFrameSize² px) is not 0 on the figure;
// `look` belongs to it.
void encodeJointNetInput(const Plane8& mask, const FigureLook& look, const FramePlacement& placement,
                         int channels, std::vector<float>& input);

// A weights file: one line of JSON (format, version, provenance, body plan, joints, hourglasses, bones,
// layers, the SHA-256 of what follows), then the weights (formatWeights()). Version 1 names no body plan: it
// was the biped; before version 3 there is one hourglass. check_hash: as in parseWeights(). Throws
// InputError.
JointNet parseJointNet(std::string_view bytes, const std::string& file, bool check_hash = true);
std::string formatJointNet(const JointNet& net);

// Nets of several body plans. Each is read when it is first asked for, since that takes time.
class JointNets {
 public:
  // A weights file, whose bytes stay where they are as long as the nets are in use.
  struct File {
    std::string_view body_plan, bytes;
    std::string name;        // that complaints begin with
    bool check_hash = true;  // not needed for what is compiled in
  };

  explicit JointNets(std::vector<File> files);
  std::vector<std::string_view> bodyPlans() const;
  bool has(std::string_view body_plan) const;
  // `body_plan`: one of bodyPlans(). Throws InputError.
  const JointNet& of(std::string_view body_plan) const;

 private:
  struct Entry {
    File file;
    std::once_flag once;
    JointNet net;
  };
  Entry* find(std::string_view body_plan) const;

  std::vector<std::unique_ptr<Entry>> entries_;
};

// Those that are compiled in; none, where the build leaves them out (SKEL_NETS).
const JointNets& builtInJointNets();

}  // namespace skel
