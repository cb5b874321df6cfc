#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>

#include "libskel/core/error.h"
#include "libskel/draw/canvas.h"
#include "libskel/image/formats.h"
#include "libskel/video/figure_in_frame.h"
#include "libskel/video/formats.h"

namespace skel {

void checkFrameSize(std::int64_t width, std::int64_t height, const std::string& file) {
  checkSize(width, height, file);
  if (width * height > kMostFramePixels)
    throw InputError(file, "has frames of " + std::to_string(width) + "x" + std::to_string(height) + " px; " +
                               std::to_string(kMostFramePixels / 1'000'000) +
                               " million px are the most: scale it down");
}

Image shrunk(Image frame) {
  const int times = (std::max(frame.width, frame.height) - 1) / kLongestFrameSide_px + 1;
  if (times == 1) return frame;
  const int width = std::max(1, frame.width / times), height = std::max(1, frame.height / times);
  // Ten times as fast, but colours of clear pixels would bleed.
  if (hasTransparency(frame)) return resized(frame, width, height);
  Image small(width, height);
  cv::Mat target(height, width, CV_8UC4, small.rgba.data());
  const cv::Mat whole(frame.height, frame.width, CV_8UC4, frame.rgba.data());
  const cv::Size size(std::min(frame.width, times * width), std::min(frame.height, times * height));
  cv::resize(whole(cv::Rect({}, size)), target, target.size(), 0, 0, cv::INTER_AREA);
  return small;
}

}  // namespace skel
