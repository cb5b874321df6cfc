// A line of ground that a figure stands on.
#pragma once

namespace cv {
class Mat;
}

namespace skel {

// Cuts a thin, nearly level line off `figure` that runs out of it to the sides near its feet, and opens what
// it encloses between the legs. `lines`: the strokes and fills that `figure` was filled from. What has the
// line for a sole stays. False, and nothing changed, if there is no such line.
bool dropGround(cv::Mat& figure, const cv::Mat& lines);

}  // namespace skel
