// Ground that a figure's lines enclose, such as between an arm on the hip and the body: told by a small net
// from clothes and skin that are as white as the paper.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "libskel/core/logistic_net.h"

namespace cv {
class Mat;
}

namespace skel {

// A region of a figure on which nothing is drawn, all of it surrounded by what is.
struct Loop {
  std::vector<int> pixels;  // y · columns + x, ascending
  Eigen::VectorXd inputs;   // kLoopInputs
};

inline constexpr auto kLoopInputs = std::to_array<std::string_view>(
    {"area",         "width",        "round",         "box",          "left or right",
     "down",         "box width",    "box height",    "depth",        "width of widest",
     "drawn",        "loops",        "area of loops", "outside near", "figure beyond",
     "drawn beyond", "loops beyond", "drawn around",  "colour",       "coloured ground",
     "paper",        "seen",         "least seen",    "most seen",    "seen of figure"});

// What figuresIn() of a picture leaves to be told; all of one size.
struct Enclosed {
  const cv::Mat& figure;                       // 8-bit, 255 on figures
  const cv::Mat& drawn;                        // 8-bit, 255 on lines and fills
  const cv::Mat& difference;                   // 8-bit, of each pixel's colour from that of the ground
  double different = 0;                        // from which on a colour is not the ground's
  bool colored_ground = false, paper = false;  // paper: its grain is seen
};

// Those that make up at least 0.3 % of the figure, with what their shape and place tell; the last four inputs
// are still 0.
std::vector<Loop> findLoops(const Enclosed& enclosed);

// The last four inputs. `probability`: how probably each pixel is figure (page_net.h), CV_32F, of the
// figure's size.
void lookInto(std::vector<Loop>& loops, const cv::Mat& figure, const cv::Mat& probability);

struct LoopNet {
  LogisticNet net;         // of kLoopInputs: that a loop is ground
  std::string provenance;  // how the numbers came to be, for people
};

// Takes off what is more probably ground than kSurelyGround. A hole in a body is far worse than a web beside
// it, and tidy drawings must not lose: at this chance 97 % of what is opened in drawings by hands left out is
// ground.
inline constexpr double kSurelyGround = 0.9;
void openLoops(const std::vector<Loop>& loops, const LoopNet& net, cv::Mat& figure);

// How probably what stays is ground all the same, of 255, where that is more than a fifth; 8-bit, of the
// figure's size. Empty: nowhere.
cv::Mat chanceOfGround(const std::vector<Loop>& loops, const LoopNet& net, const cv::Mat& figure);

// Files of format "skel-loop-net". Throws InputError.
LoopNet parseLoopNet(std::string_view text, const std::string& file);
std::string formatLoopNet(const LoopNet& net);

// weights/loop_net.json, compiled in.
const LoopNet& builtInLoopNet();

}  // namespace skel
