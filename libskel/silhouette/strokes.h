// Thin strokes, told from the noise of what they are drawn on.
#pragma once

namespace cv {
class Mat;
}

namespace skel {

// How much darker a pixel is, in its darkest channel, than the brightest level that closes over it (a black
// top-hat; on a dark background how much brighter). Blind to steps, such as the edge of a shadow. `smooth`
// takes the grain of paper off first.
cv::Mat strokeContrast(const cv::Mat& rgb, bool dark_background, bool smooth);

struct Noise {
  double level = 0, deviation = 0;  // robust, in the units of the values
};

// Of `values` where `excluded` is 0.
Noise noiseOf(const cv::Mat& values, const cv::Mat& excluded);

// Pixels above `low` that are connected to some above `high` (Canny 1986, §VIII).
cv::Mat hysteresis(const cv::Mat& values, double low, double high);

}  // namespace skel
