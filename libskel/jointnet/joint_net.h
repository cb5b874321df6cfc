// A small convolutional net that sees a whole silhouette and says where the joints are: one heatmap a joint.
// An encoder of three scales and a decoder with skips, after Newell, Yang, Deng, "Stacked hourglass networks
// for human pose estimation" (2016), much narrower. Trained on
// generated figures and on our own drawings in other poses (skel-train joints).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "libskel/image/image.h"
#include "libskel/jointnet/conv_kernels.h"
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
inline constexpr int kMaxNetJoints = 63;
// One a joint, one for the figure; the kernels want multiples of 16, so the others are idle.
constexpr int heatmapChannels(int joints) { return (joints + 1 + 15) / 16 * 16; }

struct JointNetLayer {
  enum class Kind {
    kConvolution,  // kernel × kernel, then + skip, then max(0, ·) if relu
    kPool,         // maximum of 2×2
    kUpsampleAdd,  // input twice as large by repetition, + skip
  };
  Kind kind = Kind::kConvolution;
  int input = 0;  // a map: 0 is the net's input, layer i gives map i + 1
  int skip = -1;  // a map of the output's shape, or -1
  int channels = 0;
  int kernel = 0;
  bool relu = false;
  std::size_t weights = 0, biases = 0;  // where they begin in JointNet::parameters
};

struct MapShape {
  int height, width, channels;
  std::size_t paddedSize() const {
    return static_cast<std::size_t>(paddedPixels(height, width)) * static_cast<std::size_t>(channels);
  }
};

struct JointNet {
  std::string body_plan;            // name of the template that it was trained for
  std::vector<std::string> joints;  // of the heatmaps, at most kMaxNetJoints
  std::vector<JointNetLayer> layers;
  std::vector<MapShape> maps;     // the input, then the output of each layer
  std::vector<float> parameters;  // weights of a layer (see weightIndex), then its biases
  std::string provenance;         // how the weights came to be, for people

  // The channel after the joints': its mean is the log-odds of one whole upright figure of the body plan.
  int figureChannel() const { return static_cast<int>(joints.size()); }
};

ConvShape convShape(const JointNet& net, const JointNetLayer& layer);

// The architecture with all parameters zero, for at most kMaxNetJoints joints. A net of kCoarseInputChannels
// sees lines and colours at half the resolution, one of kColourlessInputChannels silhouette and lines alone.
JointNet makeJointNet(std::string body_plan, std::vector<std::string> joints,
                      int input_channels = kNetInputChannels);

// The maps of one pass, padded as the kernels want them.
struct JointNetMaps {
  std::vector<std::vector<float>> maps;
  explicit JointNetMaps(const JointNet& net);
};

// From maps[0] to maps.back().
void forward(const JointNet& net, InstructionSet set, JointNetMaps& maps);

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

// A weights file: one line of JSON (format, version, provenance, body plan, joints, layers, the SHA-256 of
// what follows), then for each convolution `outputs` scales (float32, little endian), `outputs` biases
// (float32) and the weights as int8, in the order of JointNet::parameters; weight = int8 · scale of its
// output. Version 1 names no body plan: it was the biped. Throws InputError.
JointNet parseJointNet(std::string_view bytes, const std::string& file);
std::string formatJointNet(const JointNet& net);
// The net with its weights rounded as a weights file rounds them.
JointNet quantized(const JointNet& net);

// The names of the body plans that there is a net compiled in for.
std::span<const std::string_view> builtInJointNets();
// The net of one of them.
const JointNet& builtInJointNet(std::string_view body_plan);

}  // namespace skel
