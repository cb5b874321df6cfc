// A folder of pictures as a film.
#include <algorithm>
#include <array>
#include <filesystem>
#include <vector>

#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/natural_order.h"
#include "libskel/image/read_image.h"
#include "libskel/image/result_picture.h"
#include "libskel/video/formats.h"

namespace skel {
namespace {
namespace fs = std::filesystem;

bool isPicture(const std::string& path) {
  constexpr std::array<std::string_view, 7> kEndings = {".png", ".jpg", ".jpeg", ".webp",
                                                        ".bmp", ".tif", ".tiff"};
  return std::find(kEndings.begin(), kEndings.end(), endingOf(path)) != kEndings.end() &&
         !isResultPicture(path);
}

class FolderReader : public VideoReader {
 public:
  FolderReader(const std::string& dir, double frame_rate) : files_(framesIn(dir)) {
    for (const std::string& file : files_) noteInput(file);
    frame_rate_ = frame_rate;
    frame_count_ = static_cast<int>(files_.size());
  }

  bool next(VideoFrame& frame) override {
    if (next_ == files_.size()) return false;
    frame.file = files_[next_];
    frame.image = readImage(frame.file);
    if (next_ == 0) {
      width_ = frame.image.width, height_ = frame.image.height;
      checkFrameSize(width_, height_, frame.file);
    }
    if (frame.image.width != width_ || frame.image.height != height_)
      throw InputError(frame.file, "has " + std::to_string(frame.image.width) + "x" +
                                       std::to_string(frame.image.height) + " px, the first frame " +
                                       std::to_string(width_) + "x" + std::to_string(height_) +
                                       "; the frames of a film are of one size");
    frame.time_s = static_cast<double>(next_++) / frame_rate_;
    return true;
  }

 private:
  std::vector<std::string> files_;
  std::size_t next_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace

std::vector<std::string> framesIn(const std::string& dir) {
  std::vector<std::string> files = filesBelow(dir);
  std::erase_if(files, [](const std::string& file) { return !isPicture(file); });
  if (files.empty()) throw InputError(dir, "holds no pictures");
  std::sort(files.begin(), files.end(), comesBefore);
  return files;
}

std::unique_ptr<VideoReader> readFrameFolder(const std::string& dir, double frame_rate) {
  return std::make_unique<FolderReader>(dir, frame_rate);
}

std::unique_ptr<VideoReader> readVideo(const std::string& path, double folder_frame_rate) {
  if (fs::is_directory(path)) return readFrameFolder(path, folder_frame_rate);
  if (!fs::exists(path)) throw InputError(path, "does not exist");
  if (!fs::is_regular_file(path))
    throw InputError(path,
                     "is a pipe or a device; films are read from files, and more than once: save it first");
  if (endingOf(path) == ".webp") {
#ifdef SKEL_VIDEO_WEBP
    return readWebp(path);
#else
    throw UnavailableError(path +
                           ": for .webp install libwebp-dev and build again, or give a folder of frames");
#endif
  }
#ifdef SKEL_VIDEO_MP4
  return readFilm(path);
#else
  throw UnavailableError(path +
                         ": this build of skel reads folders of frames alone; for films install "
                         "libavformat-dev and libswscale-dev and build again");
#endif
}

}  // namespace skel
