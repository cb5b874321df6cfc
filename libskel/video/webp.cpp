// Animated WebP by libwebp.
#include <webp/encode.h>
#include <webp/mux.h>

#include <cmath>
#include <limits>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/video/formats.h"

namespace skel {
namespace {

class Webp : public VideoWriter {
 public:
  Webp(std::string path, const VideoOptions& options) : path_(std::move(path)), options_(options) {
    WebPAnimEncoderOptions settings;
    if (!WebPAnimEncoderOptionsInit(&settings) || !WebPConfigInit(&config_))
      throw UnavailableError(path_ +
                             ": the libwebp that is installed is not the one that skel was built with");
    settings.anim_params.loop_count = 0;  // for ever
    settings.minimize_size = settings.allow_mixed = 0;
    settings.kmax = std::numeric_limits<int>::max();  // the first frame alone is a key frame
    settings.kmin = settings.kmax - 1;
    config_.quality = 85;
    config_.method = 2;  // twice as fast as the default, files a tenth larger
    config_.thread_level = 0;
    encoder_ = WebPAnimEncoderNew(options_.width, options_.height, &settings);
    if (!encoder_) throw std::bad_alloc();
  }
  ~Webp() override { WebPAnimEncoderDelete(encoder_); }

  void add(const Image& frame) override {
    SKEL_CHECK_EQ(frame.width, options_.width);
    SKEL_CHECK_EQ(frame.height, options_.height);
    WebPPicture picture;
    if (!WebPPictureInit(&picture)) throw std::bad_alloc();
    picture.width = frame.width;
    picture.height = frame.height;
    picture.use_argb = 1;
    const int row_bytes = 4 * frame.width;
    const bool added =
        (options_.transparent ? WebPPictureImportRGBA(&picture, frame.rgba.data(), row_bytes)
                              : WebPPictureImportRGBX(&picture, frame.rgba.data(), row_bytes)) &&
        WebPAnimEncoderAdd(encoder_, &picture, start_ms(count_), &config_);
    WebPPictureFree(&picture);
    require(added);
    ++count_;
  }

  void finish() override {
    SKEL_CHECK(count_ > 0);
    require(WebPAnimEncoderAdd(encoder_, nullptr, start_ms(count_), nullptr));
    WebPData data;
    WebPDataInit(&data);
    require(WebPAnimEncoderAssemble(encoder_, &data));
    const std::string bytes(reinterpret_cast<const char*>(data.bytes), data.size);
    WebPDataClear(&data);
    writeFile(path_, bytes);
  }

 private:
  int start_ms(int frame) const { return static_cast<int>(std::lround(frame * 1000 / options_.frame_rate)); }
  void require(bool done) const {
    if (!done)
      throw OutputError(path_,
                        std::string("cannot be encoded as WebP: ") + WebPAnimEncoderGetError(encoder_));
  }

  std::string path_;
  VideoOptions options_;
  WebPConfig config_;
  WebPAnimEncoder* encoder_ = nullptr;
  int count_ = 0;
};

}  // namespace

std::unique_ptr<VideoWriter> openWebp(const std::string& path, const VideoOptions& options) {
  return std::make_unique<Webp>(path, options);
}

}  // namespace skel
