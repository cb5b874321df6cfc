// Animated WebP by libwebp, which FFmpeg does not read.
#include <webp/demux.h>

#include <algorithm>
#include <cstdint>

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/image/formats.h"
#include "libskel/video/formats.h"

namespace skel {
namespace {

class WebpReader : public VideoReader {
 public:
  explicit WebpReader(const std::string& path) : path_(path), bytes_(readFile(path)) {
    if (formatOf(bytes_) != Format::kWebp) throw InputError(path_, "cannot be read as WebP");
    const HeaderSize size = headerSize(bytes_, Format::kWebp);
    checkFrameSize(size.width, size.height, path_);
    WebPAnimDecoderOptions settings;
    if (!WebPAnimDecoderOptionsInit(&settings))
      throw UnavailableError(path_ +
                             ": the libwebp that is installed is not the one that skel was built with");
    settings.color_mode = MODE_RGBA;
    const WebPData data{reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size()};
    decoder_.reset(WebPAnimDecoderNew(&data, &settings));
    if (!decoder_ || !WebPAnimDecoderGetInfo(decoder_.get(), &info_))
      throw InputError(path_, "cannot be read as WebP");
    if (info_.frame_count == 0) throw InputError(path_, "holds a film without frames");
    frame_count_ = static_cast<int>(info_.frame_count);
    const WebPDemuxer* demuxer = WebPAnimDecoderGetDemuxer(decoder_.get());
    std::int64_t duration_ms = 0;
    WebPIterator part;
    if (WebPDemuxGetFrame(demuxer, 1, &part)) {
      do duration_ms += part.duration;
      while (WebPDemuxNextFrame(&part));
      WebPDemuxReleaseIterator(&part);
    }
    frame_rate_ = 1000. * frame_count_ / double(std::max<std::int64_t>(1, duration_ms));
  }

  bool next(VideoFrame& out) override {
    if (!WebPAnimDecoderHasMoreFrames(decoder_.get())) return false;
    std::uint8_t* pixels = nullptr;
    int end_ms = 0;  // of the frame
    if (!WebPAnimDecoderGetNext(decoder_.get(), &pixels, &end_ms))
      throw InputError(path_, "cannot be read from frame " + std::to_string(count_ + 1) + " on");
    out.image = Image(static_cast<int>(info_.canvas_width), static_cast<int>(info_.canvas_height));
    std::copy_n(pixels, out.image.rgba.size(), out.image.rgba.data());
    out.image = shrunk(std::move(out.image));
    out.file.clear();
    out.time_s = start_s_;
    start_s_ = std::max(end_ms / 1000., start_s_ + 1e-4);
    ++count_;
    return true;
  }

 private:
  struct Delete {
    void operator()(WebPAnimDecoder* decoder) const { WebPAnimDecoderDelete(decoder); }
  };

  std::string path_, bytes_;
  std::unique_ptr<WebPAnimDecoder, Delete> decoder_;
  WebPAnimInfo info_{};
  double start_s_ = 0;
  int count_ = 0;
};

}  // namespace

std::unique_ptr<VideoReader> readWebp(const std::string& path) { return std::make_unique<WebpReader>(path); }

}  // namespace skel
