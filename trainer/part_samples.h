// What the part net learns from: figures of which each pixel's part is known.
#pragma once

#include <array>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "libskel/core/rng.h"
#include "libskel/layers/part_net.h"
#include "trainer/jointed_drawing.h"
#include "trainer/part_truth.h"

namespace skel {

// Every point of a skeleton anew.
PartSkeleton moved(const PartSkeleton& skeleton,
                   const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& move);

// All of one size; the figure's box.
struct PartSample {
  cv::Mat rgb;            // CV_8UC3
  cv::Mat mask;           // CV_8U, not 0 on the figure
  cv::Mat part;           // CV_8U: a Part, or kNoPart
  cv::Mat order;          // CV_16U: what has more lies before what has less
  PartSkeleton skeleton;  // px, the corner of the first at 0
  bool side_view = false;
};

// Of each limb: 1 if it lies before what it borders on, 0 if behind, -1 if it borders on nothing, or on some
// this and on some that.
std::array<int, 4> limbsBefore(const PartSample& sample);

// Those whose shapes script/shape-maps has written to a folder, with the file of these. Throws InputError:
// there is no such folder.
std::vector<std::pair<JointedDrawing, std::string>> drawingsWithShapes(
    const std::vector<JointedDrawing>& drawings, const std::string& shapes);

// A drawing with its shapes, of the picture's size; nothing if its parts are
// doubtful. Throws InputError.
std::optional<PartSample> readPartSample(const JointedDrawing& drawing, const std::string& shapes_file);
// The figure's box, its long side at most kPartSourceSize.
inline constexpr int kPartSourceSize = 224;
PartSample smallPartSample(const PartSample& sample);
// With so many px of white around it.
PartSample withMargin(const PartSample& sample, int margin);

// A figure of the generator, its long side kPartNetSize.
PartSample generatedPartSample(Rng& rng, const std::string& body_plan);
// The sample turned, stretched, perhaps mirrored, its long side kPartNetSize.
PartSample warpedPartSample(Rng& rng, const PartSample& sample);
// As it is, its long side kPartNetSize.
PartSample fittedPartSample(const PartSample& sample);
// In other colours, with a ragged outline.
void repaintPartSample(Rng& rng, PartSample& sample);
// Joints as another net would have found them, roughly.
PartSkeleton withNoise(Rng& rng, const PartSkeleton& skeleton, double long_side);

}  // namespace skel
