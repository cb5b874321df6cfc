#include "libskel/video/video_writer.h"

#include <filesystem>

#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/core/files.h"
#include "libskel/video/formats.h"

namespace skel {
namespace {
namespace fs = std::filesystem;

// More than any encoder takes.
constexpr int kMaxSide_px = 16383;
constexpr double kMinFrameRate = 0.1, kMaxFrameRate = 240;

// "": a folder of frames.
std::string filmEndingOf(const std::string& path) {
  return path.ends_with('/') || fs::is_directory(path) ? "" : endingOf(path);
}

[[noreturn]] [[maybe_unused]] void lacking(const std::string& path, const std::string& packages) {
  throw UnavailableError(path + ": this build of skel writes " + videoFormatNames() + "; for " +
                         filmEndingOf(path) + " install " + packages + " and build again");
}

}  // namespace

std::string videoFormatNames() {
  std::string names;
#ifdef SKEL_VIDEO_MP4
  names += ".mp4, ";
#endif
#ifdef SKEL_VIDEO_GIF
  names += ".gif, ";
#endif
#ifdef SKEL_VIDEO_WEBP
  names += ".webp, ";
#endif
  return names + "a folder";
}

bool isFrameFolder(const std::string& path) { return filmEndingOf(path).empty(); }

bool keepsTransparency(const std::string& path) { return filmEndingOf(path) != ".mp4"; }

void checkVideo(const VideoOptions& options) {
  if (options.width < 1 || options.height < 1 || options.width > kMaxSide_px || options.height > kMaxSide_px)
    throw UsageError("a film of " + std::to_string(options.width) + "x" + std::to_string(options.height) +
                     " px cannot be written; sides go from 1 to " + std::to_string(kMaxSide_px));
  if (!(options.frame_rate >= kMinFrameRate && options.frame_rate <= kMaxFrameRate))
    throw UsageError("a film cannot have " + std::to_string(options.frame_rate) +
                     " frames a second; 0.1 to 240 can be written");
}

std::unique_ptr<VideoWriter> openVideo(const std::string& path, const VideoOptions& options) {
  if (path.empty()) throw UsageError("name the film that is to be written");
  checkVideo(options);
  const std::string ending = filmEndingOf(path);
  if (ending.empty()) return openFrameFolder(path, options);
  ensureWritableFolderOf(path);
  if (ending == ".mp4") {
#ifdef SKEL_VIDEO_MP4
    return openMp4(path, options);
#else
    lacking(path, "libavformat-dev and libswscale-dev");
#endif
  }
  if (ending == ".gif") {
#ifdef SKEL_VIDEO_GIF
    return openGif(path, options);
#else
    lacking(path, "libgif-dev");
#endif
  }
  if (ending == ".webp") {
#ifdef SKEL_VIDEO_WEBP
    return openWebp(path, options);
#else
    lacking(path, "libwebp-dev");
#endif
  }
  throw UsageError(path +
                   ": films are written as .mp4, .gif, .webp, or into a folder (a name that ends with /)");
}

}  // namespace skel
