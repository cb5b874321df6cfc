// Films, read frame by frame.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "libskel/image/image.h"

namespace skel {

struct VideoFrame {
  Image image;
  double time_s = 0;  // from the beginning of the film, later than that of the frame before
  std::string file;   // of a folder of frames: the picture's path; else empty
};

inline constexpr long kMostFramePixels = 36'000'000;  // 8192x4320
inline constexpr int kLongestFrameSide_px = 1920;

class VideoReader {
 public:
  virtual ~VideoReader() = default;
  // The next frame, all of one size. False at the end. Throws InputError.
  virtual bool next(VideoFrame& frame) = 0;
  double frameRate() const { return frame_rate_; }  // 1/s
  int frameCount() const { return frame_count_; }   // 0: only the end tells

 protected:
  double frame_rate_ = 0;
  int frame_count_ = 0;
};

// The pictures of a folder that are a film's frames, in their order. Throws InputError: no folder, no
// pictures.
std::vector<std::string> framesIn(const std::string& dir);

// A folder of pictures, in the order of their names with numbers counted as numbers, shown at
// `folder_frame_rate`, 1/s; or a film: an animated .webp, or whatever format FFmpeg reads (MP4, GIF, WebM
// ...), transparency kept, its frames shrunk where they are longer than kLongestFrameSide_px (pictures of a
// folder are not). Throws InputError: not there, no film, no pictures, frames of more than kMostFramePixels;
// UnavailableError: a film in a build without the library that reads it.
std::unique_ptr<VideoReader> readVideo(const std::string& path, double folder_frame_rate = 12);

}  // namespace skel
