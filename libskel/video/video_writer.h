// Films, written frame by frame.
#pragma once

#include <memory>
#include <string>

#include "libskel/image/image.h"

namespace skel {

struct VideoOptions {
  int width = 512, height = 512;  // px, of every frame
  double frame_rate = 30;         // 1/s
  int frames = 0;                 // how many will come, where that is known; else 0
  bool transparent = false;       // keep the frames' alpha; else it is ignored
};

// A film that is being written. Nothing is at its path before finish() has returned, but for a folder of
// frames, which fills as they come.
class VideoWriter {
 public:
  virtual ~VideoWriter() = default;
  // Frames have the size of the options. Throws OutputError.
  virtual void add(const Image& frame) = 0;
  // At least one frame has been added. Throws OutputError.
  virtual void finish() = 0;
};

// By the ending of the name:
//   .mp4   H.264, or MPEG-4 where there is no encoder for it; even sizes, no transparency
//   .gif   255 colours a frame, plays for ever; at most 50 frames a second; transparency is on or off
//   .webp  animated, plays for ever, transparency
//   none, or a slash at the end: a folder of frame-0001.png …
// The same frames give the same bytes. Throws UsageError (another ending, a size or a rate that the format
// does not have), UnavailableError (a library or an encoder that is not there), OutputError (the folder
// cannot be written to, or holds frames of another film).
std::unique_ptr<VideoWriter> openVideo(const std::string& path, const VideoOptions& options);

// What openVideo() refuses of any film, before there is one: sides beyond 1 to 16383 px, rates beyond 0.1 to
// 240 frames a second. Throws UsageError.
void checkVideo(const VideoOptions& options);

// The formats that this build can write, for --help: ".mp4, .gif, a folder".
std::string videoFormatNames();

// Whether a film of this name is a folder of frames.
bool isFrameFolder(const std::string& path);

// Whether the film at this path can be seen through.
bool keepsTransparency(const std::string& path);

}  // namespace skel
