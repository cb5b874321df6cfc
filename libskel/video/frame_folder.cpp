// A folder of PNG files, one a frame: for programs that cut films.
#include <cstdio>
#include <filesystem>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/video/formats.h"
#include "libskel/video/frame_file.h"

namespace skel {
namespace {
namespace fs = std::filesystem;

constexpr const char* kPrefix = "frame-";

std::string frameName(int number) {
  char name[32];
  std::snprintf(name, sizeof name, "%s%04d.png", kPrefix, number);
  return name;
}

class FrameFolder : public VideoWriter {
 public:
  FrameFolder(std::string dir, const VideoOptions& options) : dir_(std::move(dir)), options_(options) {
    ensureWritableFolder(dir_);
    const std::vector<std::string> there = checkFrames(dir_, kPrefix);
    if (options.frames == 0) return;
    std::set<std::string> ours;
    for (int number = 1; number <= options.frames; ++number) ours.insert(frameName(number));
    refuseOtherFrames(dir_, there, ours);
  }

  void add(const Image& frame) override {
    SKEL_CHECK_EQ(frame.width, options_.width);
    SKEL_CHECK_EQ(frame.height, options_.height);
    const std::string path = dir_ / frameName(++count_);
    if (options_.transparent) return writeFile(path, encodeFrame(frame));
    Image opaque = frame;
    opaque.rgba.col(3).setConstant(255);
    writeFile(path, encodeFrame(opaque));
  }

  void finish() override { SKEL_CHECK(count_ > 0); }

 private:
  fs::path dir_;
  VideoOptions options_;
  int count_ = 0;
};

}  // namespace

std::unique_ptr<VideoWriter> openFrameFolder(const std::string& dir, const VideoOptions& options) {
  return std::make_unique<FrameFolder>(dir, options);
}

}  // namespace skel
