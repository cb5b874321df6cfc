// Inside the room: one writer a format, and the readers.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "libskel/video/video_reader.h"
#include "libskel/video/video_writer.h"

namespace skel {

// Throws InputError where a frame has more than kMostFramePixels.
void checkFrameSize(std::int64_t width, std::int64_t height, const std::string& file);
// By the least whole number that leaves no side longer than kLongestFrameSide_px.
Image shrunk(Image frame);

std::unique_ptr<VideoWriter> openFrameFolder(const std::string& dir, const VideoOptions& options);
std::unique_ptr<VideoReader> readFrameFolder(const std::string& dir, double frame_rate);

#ifdef SKEL_VIDEO_MP4
std::unique_ptr<VideoReader> readFilm(const std::string& path);
// Encoders by FFmpeg's names, the best first; the first that is there and can be opened is taken.
std::unique_ptr<VideoWriter> openMp4(const std::string& path, const VideoOptions& options,
                                     const std::vector<std::string>& encoders = {"libx264", "libopenh264",
                                                                                 "mpeg4"});
#endif
#ifdef SKEL_VIDEO_GIF
std::unique_ptr<VideoWriter> openGif(const std::string& path, const VideoOptions& options);
#endif
#ifdef SKEL_VIDEO_WEBP
std::unique_ptr<VideoReader> readWebp(const std::string& path);
std::unique_ptr<VideoWriter> openWebp(const std::string& path, const VideoOptions& options);
#endif

}  // namespace skel
