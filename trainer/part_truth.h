// Which part each pixel of a drawing is, from the shapes that it was painted with and its joints.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "libskel/layers/part_net.h"

namespace skel {

inline constexpr std::uint8_t kNoPart = 255;  // outside of the figure, or nobody knows

struct PartTruth {
  cv::Mat part;   // CV_8U: a Part, or kNoPart
  cv::Mat order;  // CV_16U: what has more lies before what has less; 0 outside
};

// `shapes`: the picture that script/shape-maps makes, as CV_8UC3 in the order red, green, blue; `skeleton` in
// px of it. A shape goes to the limb along whose bones it lies, to the trunk or the head; what spans both
// legs is a skirt; what is far from all bones hair, a cape or a thing; what fits nowhere is divided along
// bones. Nothing where too much of it is doubtful.
std::optional<PartTruth> partTruth(const cv::Mat& shapes, const PartSkeleton& skeleton);

}  // namespace skel
