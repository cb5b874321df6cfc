// Animated GIF (GIF89a, with the loop extension of Netscape 2.0) by giflib. Each frame brings its own palette
// and, where the film is opaque, only what has changed.
#include <gif_lib.h>

#include <algorithm>
#include <cmath>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/video/formats.h"
#include "libskel/video/palette.h"

namespace skel {
namespace {

constexpr double kTicks = 100;  // a second

int append(GifFileType* gif, const GifByteType* data, int size) {
  static_cast<std::string*>(gif->UserData)
      ->append(reinterpret_cast<const char*>(data), static_cast<size_t>(size));
  return size;
}

// The pixels that a frame paints, and the smallest box around them.
struct Change {
  std::vector<bool> paints;  // H·W
  int x0, y0, x1, y1;        // the last ones are in it; x1 < x0: nothing
};

class Gif : public VideoWriter {
 public:
  Gif(std::string path, const VideoOptions& options) : path_(std::move(path)), options_(options) {
    gif_ = EGifOpen(&bytes_, append, nullptr);
    if (!gif_) throw std::bad_alloc();
    EGifSetGifVersion(gif_, true);
    require(EGifPutScreenDesc(gif_, options_.width, options_.height, 8, 0, nullptr));
    const unsigned char for_ever[] = {1, 0, 0};
    require(EGifPutExtensionLeader(gif_, APPLICATION_EXT_FUNC_CODE));
    require(EGifPutExtensionBlock(gif_, 11, "NETSCAPE2.0"));
    require(EGifPutExtensionBlock(gif_, sizeof for_ever, for_ever));
    require(EGifPutExtensionTrailer(gif_));
  }
  ~Gif() override {
    if (gif_) EGifCloseFile(gif_, nullptr);
  }

  void add(const Image& frame) override {
    SKEL_CHECK_EQ(frame.width, options_.width);
    SKEL_CHECK_EQ(frame.height, options_.height);
    const Change change = changeOf(frame);
    const int width = std::max(1, change.x1 - change.x0 + 1), height = std::max(1, change.y1 - change.y0 + 1);
    std::vector<Rgb> pixels;
    for (int y = change.y0; y <= change.y1; ++y)
      for (int x = change.x0; x <= change.x1; ++x)
        if (change.paints[place(x, y)]) {
          const std::uint8_t* p = frame.pixel(x, y);
          pixels.push_back({p[0], p[1], p[2]});
        }
    const Palette palette = choosePalette(pixels, 255);
    const int clear = static_cast<int>(palette.colors.size());

    // Rounded from the start of the film on, so that it takes as long as it should.
    const auto ticks = [&](int frames) { return std::lround(frames * kTicks / options_.frame_rate); };
    GraphicsControlBlock control;
    control.DisposalMode = options_.transparent ? DISPOSE_BACKGROUND : DISPOSE_DO_NOT;
    control.UserInputFlag = false;
    control.DelayTime = static_cast<int>(ticks(count_ + 1) - ticks(count_));
    control.TransparentColor = clear;
    GifByteType extension[4];
    EGifGCBToExtension(&control, extension);
    require(EGifPutExtension(gif_, GRAPHICS_EXT_FUNC_CODE, sizeof extension, extension));

    // A power of two, at least.
    int size = 2;
    while (size <= clear) size *= 2;
    std::vector<GifColorType> colors(static_cast<size_t>(size), GifColorType{0, 0, 0});
    for (size_t i = 0; i < palette.colors.size(); ++i)
      colors[i] = {palette.colors[i][0], palette.colors[i][1], palette.colors[i][2]};
    ColorMapObject* map = GifMakeMapObject(size, colors.data());
    if (!map) throw std::bad_alloc();
    const int described =
        EGifPutImageDesc(gif_, std::min(change.x0, options_.width - 1),
                         std::min(change.y0, options_.height - 1), width, height, false, map);
    GifFreeMapObject(map);
    require(described);
    std::vector<GifPixelType> row(static_cast<size_t>(width), static_cast<GifPixelType>(clear));
    size_t next = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const bool paints = change.x0 <= change.x1 && change.paints[place(change.x0 + x, change.y0 + y)];
        row[static_cast<size_t>(x)] = paints ? palette.indices[next++] : static_cast<GifPixelType>(clear);
      }
      require(EGifPutLine(gif_, row.data(), width));
    }
    if (!options_.transparent) before_ = frame;
    ++count_;
  }

  void finish() override {
    SKEL_CHECK(count_ > 0);
    GifFileType* gif = gif_;
    gif_ = nullptr;
    require(EGifCloseFile(gif, nullptr));
    writeFile(path_, bytes_);
  }

 private:
  void require(int result) const {
    if (result != GIF_OK) throw OutputError(path_, "cannot be encoded as GIF");
  }
  size_t place(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(options_.width) + static_cast<size_t>(x);
  }

  Change changeOf(const Image& frame) const {
    Change change{
        std::vector<bool>(static_cast<size_t>(options_.width) * static_cast<size_t>(options_.height)),
        options_.width, options_.height, -1, -1};
    for (int y = 0; y < options_.height; ++y)
      for (int x = 0; x < options_.width; ++x) {
        const std::uint8_t* p = frame.pixel(x, y);
        if (options_.transparent ? p[3] < 128 : count_ > 0 && std::equal(p, p + 3, before_.pixel(x, y)))
          continue;
        change.paints[place(x, y)] = true;
        change.x0 = std::min(change.x0, x), change.x1 = std::max(change.x1, x);
        change.y0 = std::min(change.y0, y), change.y1 = std::max(change.y1, y);
      }
    return change;
  }

  std::string path_;
  VideoOptions options_;
  std::string bytes_;
  GifFileType* gif_ = nullptr;
  Image before_;
  int count_ = 0;
};

}  // namespace

std::unique_ptr<VideoWriter> openGif(const std::string& path, const VideoOptions& options) {
  // Viewers play shorter frames slowly.
  if (options.frame_rate > kTicks / 2)
    throw UsageError(path +
                     ": a GIF has at most 50 frames a second; take a lower rate, or write .webp or .mp4");
  return std::make_unique<Gif>(path, options);
}

}  // namespace skel
