// A convolutional net that sees a whole page and says which of it is the figure, and which is paper, table,
// ruling, ground, a house, a shadow. Trained on generated pages (skel-train pages).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "libskel/convnet/conv_net.h"

namespace cv {
class Mat;
}

namespace skel {

// The net looks at a picture with this long side, in the upper left of a square; its input map has 2×2 px of
// that in each of its pixels, and so has its output map.
inline constexpr int kPageNetSize = 192;
inline constexpr int kPageMapSize = kPageNetSize / 2;
inline constexpr int kPageInputChannels = 16, kPageOutputChannels = 16;

struct PageNet : ConvNet {
  std::string provenance;  // how the weights came to be, for people
};

// With all parameters zero.
PageNet makePageNet();
// Fills the input map. `rgb`: 8-bit, at most kPageNetSize px wide and high.
void encodePage(const cv::Mat& rgb, std::vector<float>& input);
// In the output map channel 2·(y mod 2) + x mod 2 of pixel (y / 2, x / 2) is the log-odds of px (x, y).
inline constexpr std::size_t pageLogitIndex(int y, int x) {
  return static_cast<std::size_t>(paddedIndex(kPageMapSize, y / 2, x / 2)) * kPageOutputChannels +
         static_cast<std::size_t>(2 * (y % 2) + x % 2);
}

// One line of JSON (format, version, provenance, SHA-256 of what follows), then the weights
// (formatWeights()). Throws InputError.
PageNet parsePageNet(std::string_view bytes, const std::string& file, bool check_hash = true);
std::string formatPageNet(const PageNet& net);
// The net that is compiled in. Throws UsageError where the build leaves it out (SKEL_NETS).
const PageNet& builtInPageNet();
bool hasBuiltInPageNet();

// How probably each px is figure: CV_32F of the size of `rgb` (8-bit), 0…1. The page is looked at whole and,
// where a figure is seen, once more around it.
cv::Mat figureProbability(const PageNet& net, const cv::Mat& rgb);

}  // namespace skel
