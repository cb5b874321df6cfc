// Convolutional nets as lists of layers: what the joint net and the page net are made of.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "libskel/convnet/conv_kernels.h"

namespace skel {

class JsonValue;

struct ConvLayer {
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
  std::size_t weights = 0, biases = 0;  // where they begin in ConvNet::parameters
  std::size_t transformed = 0;          // and in ConvNet::transformed
};

struct MapShape {
  int height, width, channels;
  std::size_t paddedSize() const {
    return static_cast<std::size_t>(paddedPixels(height, width)) * static_cast<std::size_t>(channels);
  }
};

struct ConvNet {
  std::vector<ConvLayer> layers;
  std::vector<MapShape> maps;                  // the input, then the output of each layer
  std::vector<float> parameters;               // weights of a layer (see weightIndex), then its biases
  std::shared_ptr<const float[]> transformed;  // see transformWeights(); null: not made
};

// Has forward() take less time (winograd.h). To be called anew after each change of the parameters.
void transformWeights(ConvNet& net);
// A net of any kind that is only run from now on.
template <typename Net>
Net readyToRun(Net net) {
  transformWeights(net);
  return net;
}

ConvShape convShape(const ConvNet& net, const ConvLayer& layer);

// Adds layers to a net one by one, with all parameters zero. Maps are named by their number.
class ConvNetBuilder {
 public:
  explicit ConvNetBuilder(const MapShape& input) { net_.maps.push_back(input); }

  int convolution(int input, int channels, int kernel, bool relu, int skip = -1);
  int pool(int input);
  int upsampleAdd(int input, int skip);
  // `count` convolutions of 3×3 that each add to their input.
  int residuals(int map, int count);
  ConvNet take();

 private:
  int add(const ConvLayer& layer, const MapShape& shape);
  ConvNet net_;
  std::size_t parameter_count_ = 0;
};

// An encoder and a decoder with skips between equal resolutions, after Newell, Yang, Deng, "Stacked hourglass
// networks for human pose estimation" (2016), much narrower. widths[i] channels at 1 / 2^i of the resolution
// of `map`, which has widths[0]; down[i] residual convolutions at 1 / 2^(i + 1) on the way down, up[i] at
// 1 / 2^(last - 1 - i) on the way up, which ends there. Returns the last map.
int hourglass(ConvNetBuilder& builder, int map, std::span<const int> widths, std::span<const int> down,
              std::span<const int> up);

// The maps of one pass, padded as the kernels want them.
struct ConvNetMaps {
  std::vector<std::vector<float>> maps;
  std::vector<float> scratch;
  explicit ConvNetMaps(const ConvNet& net);
};

// From maps[0] to maps.back(). Throws Error where that becomes infinite.
void forward(const ConvNet& net, InstructionSet set, ConvNetMaps& maps);

// --- weights as bytes
// For each convolution `outputs` scales (float32, little endian), `outputs` biases (float32) and the weights
// as int8, in the order of ConvNet::parameters; weight = int8 · scale of its output.
std::string formatWeights(const ConvNet& net);
// Into a net of the same layers, which `header` (of the file) tells under "convolutions" as
// convolutionSizes() does, beside the bytes' "sha256". Throws InputError where either does not fit, where
// there are too few or too many bytes, or where they are no numbers. check_hash: not needed for what is
// compiled in.
void parseWeights(std::string_view bytes, const JsonValue& header, const std::string& file, ConvNet& net,
                  bool check_hash = true);
// Rounds the weights as their bytes do.
void quantize(ConvNet& net);
// [inputs, outputs, kernel] of each convolution: what the bytes are laid out by.
std::vector<std::array<int, 3>> convolutionSizes(const ConvNet& net);

}  // namespace skel
