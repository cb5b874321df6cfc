// MP4 through FFmpeg's libraries. They are called without OpenCV's videoio in between: that would load 150
// other libraries, hold 70 MB more, and tell nobody when the disk is full.
#include <algorithm>
#include <cerrno>
#include <cstring>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/video/formats.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

namespace skel {
namespace {

// The callback's bytes became const with libavformat 61.
#if LIBAVFORMAT_VERSION_MAJOR >= 61
using Written = const std::uint8_t;
#else
using Written = std::uint8_t;
#endif

// Nothing is left to what an encoder takes for good on this machine, or to when its threads come by: one
// thread, no others that look ahead, key frames where the numbers of the frames say, and a rate that follows
// from the quality.
constexpr int kFramesFromKeyToKey = 250, kLeastFramesFromKeyToKey = 25;
constexpr const char* kX264 =
    "threads=1:lookahead-threads=1:sliced-threads=0:sync-lookahead=0:non-deterministic=0:cpu-independent=1:"
    "rc-lookahead=10";

// What FFmpeg would write to a file, in memory: the muxer goes back to the beginning at the end.
struct Memory {
  std::string bytes;
  std::int64_t at = 0;

  static int write(void* opaque, Written* data, int size) {
    auto& self = *static_cast<Memory*>(opaque);
    const auto at = static_cast<std::size_t>(self.at), count = static_cast<std::size_t>(size);
    if (self.bytes.size() < at + count) self.bytes.resize(at + count);
    std::memcpy(self.bytes.data() + at, data, count);
    self.at += size;
    return size;
  }
  static std::int64_t seek(void* opaque, std::int64_t offset, int whence) {
    auto& self = *static_cast<Memory*>(opaque);
    const auto size = static_cast<std::int64_t>(self.bytes.size());
    if (whence & AVSEEK_SIZE) return size;
    const std::int64_t to = offset + (whence == SEEK_CUR ? self.at : whence == SEEK_END ? size : 0);
    return to < 0 || to > size ? -EINVAL : self.at = to;
  }
};

class Mp4 : public VideoWriter {
 public:
  Mp4(std::string path, const VideoOptions& options, const std::vector<std::string>& encoders)
      : path_(std::move(path)), options_(options) {
    av_log_set_level(AV_LOG_QUIET);
    std::string tried;
    for (const std::string& name : encoders) {
      if (openEncoder(name)) break;
      tried += (tried.empty() ? "" : ", ") + name;
    }
    if (!encoder_)
      throw UnavailableError(path_ + ": FFmpeg has no encoder for it here (tried " + tried +
                             "); install libavcodec-extra, or write .gif or .webp");
    openFile();
    scaler_ = sws_getContext(options_.width, options_.height, AV_PIX_FMT_RGBA, options_.width,
                             options_.height, AV_PIX_FMT_YUV420P,
                             SWS_BILINEAR | SWS_ACCURATE_RND | SWS_BITEXACT, nullptr, nullptr, nullptr);
    packet_ = av_packet_alloc();
    if (!scaler_ || !packet_) throw std::bad_alloc();
  }

  ~Mp4() override {
    av_packet_free(&packet_);
    sws_freeContext(scaler_);
    avcodec_free_context(&encoder_);
    if (file_ && file_->pb) {
      av_freep(&file_->pb->buffer);
      avio_context_free(&file_->pb);
    }
    avformat_free_context(file_);
  }

  void add(const Image& image) override {
    SKEL_CHECK_EQ(image.width, options_.width);
    SKEL_CHECK_EQ(image.height, options_.height);
    // A frame of its own each time: the encoder keeps some to look ahead.
    AVFrame* frame = av_frame_alloc();
    if (!frame) throw std::bad_alloc();
    frame->format = AV_PIX_FMT_YUV420P;
    frame->width = image.width;
    frame->height = image.height;
    frame->pts = count_++;
    const std::uint8_t* rows[] = {image.rgba.data()};
    const int row_bytes[] = {4 * image.width};
    int failure = av_frame_get_buffer(frame, 0);
    if (failure >= 0) {
      // The encoder also reads what lies beyond the picture's edges.
      for (AVBufferRef* buffer : frame->buf)
        if (buffer) std::memset(buffer->data, 0, buffer->size);
      sws_scale(scaler_, rows, row_bytes, 0, image.height, frame->data, frame->linesize);
      failure = avcodec_send_frame(encoder_, frame);
    }
    av_frame_free(&frame);
    require(failure);
    writePackets();
  }

  void finish() override {
    SKEL_CHECK(count_ > 0);
    require(avcodec_send_frame(encoder_, nullptr));
    writePackets();
    require(av_write_trailer(file_));
    avio_flush(file_->pb);
    writeFile(path_, memory_.bytes);
  }

 private:
  void require(int result) const {
    if (result >= 0) return;
    char why[AV_ERROR_MAX_STRING_SIZE] = "";
    av_strerror(result, why, sizeof why);
    throw OutputError(path_, std::string("cannot be encoded: ") + why);
  }

  bool openEncoder(const std::string& name) {
    const AVCodec* codec = avcodec_find_encoder_by_name(name.c_str());
    if (!codec) return false;
    encoder_ = avcodec_alloc_context3(codec);
    if (!encoder_) throw std::bad_alloc();
    encoder_->width = options_.width;
    encoder_->height = options_.height;
    encoder_->pix_fmt = AV_PIX_FMT_YUV420P;
    encoder_->framerate = av_d2q(options_.frame_rate, 65535);
    encoder_->time_base = av_inv_q(encoder_->framerate);
    encoder_->sample_aspect_ratio = {1, 1};
    encoder_->color_range = AVCOL_RANGE_MPEG;  // and the matrix that swscale takes unless told otherwise
    encoder_->colorspace = AVCOL_SPC_SMPTE170M;
    encoder_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER | AV_CODEC_FLAG_BITEXACT;
    // More threads would change the bytes; frames are drawn on the other cores meanwhile.
    encoder_->thread_count = 1;
    encoder_->thread_type = 0;
    encoder_->gop_size = kFramesFromKeyToKey;
    encoder_->keyint_min = kLeastFramesFromKeyToKey;
    AVDictionary* settings = nullptr;
    if (name == "libx264") {
      // Twice as fast as the preset "medium" and no larger for drawings. The quality is what drawn lines need
      // to stay clean.
      av_dict_set(&settings, "preset", "veryfast", 0);
      av_dict_set(&settings, "crf", "19", 0);
      av_dict_set(&settings, "x264-params", kX264, 0);
    } else {
      encoder_->bit_rate = std::int64_t{4} * options_.width * options_.height;
      encoder_->flags |= AV_CODEC_FLAG_QSCALE;
      encoder_->global_quality = 3 * FF_QP2LAMBDA;
    }
    const int failure = avcodec_open2(encoder_, codec, &settings);
    av_dict_free(&settings);
    if (failure < 0) avcodec_free_context(&encoder_);
    // A library that is not there leaves it to the next encoder. One that lacks memory does not: the film
    // would be another, without a word.
    if (failure == AVERROR(ENOMEM) || failure == AVERROR_EXTERNAL) require(failure);
    return failure >= 0;
  }

  void openFile() {
    require(avformat_alloc_output_context2(&file_, nullptr, "mp4", nullptr));
    constexpr int kBufferBytes = 1 << 16;
    auto* buffer = static_cast<unsigned char*>(av_malloc(kBufferBytes));
    file_->pb =
        buffer ? avio_alloc_context(buffer, kBufferBytes, 1, &memory_, nullptr, Memory::write, Memory::seek)
               : nullptr;
    if (!file_->pb) throw std::bad_alloc();
    file_->flags |= AVFMT_FLAG_BITEXACT;
    stream_ = avformat_new_stream(file_, nullptr);
    if (!stream_) throw std::bad_alloc();
    stream_->time_base = encoder_->time_base;
    stream_->avg_frame_rate = encoder_->framerate;
    require(avcodec_parameters_from_context(stream_->codecpar, encoder_));
    require(avformat_write_header(file_, nullptr));
  }

  void writePackets() {
    for (;;) {
      const int got = avcodec_receive_packet(encoder_, packet_);
      if (got == AVERROR(EAGAIN) || got == AVERROR_EOF) return;
      require(got);
      if (packet_->duration == 0) packet_->duration = 1;
      av_packet_rescale_ts(packet_, encoder_->time_base, stream_->time_base);
      packet_->stream_index = stream_->index;
      require(av_interleaved_write_frame(file_, packet_));
    }
  }

  std::string path_;
  VideoOptions options_;
  Memory memory_;
  AVCodecContext* encoder_ = nullptr;
  AVFormatContext* file_ = nullptr;
  AVStream* stream_ = nullptr;
  SwsContext* scaler_ = nullptr;
  AVPacket* packet_ = nullptr;
  int count_ = 0;
};

}  // namespace

std::unique_ptr<VideoWriter> openMp4(const std::string& path, const VideoOptions& options,
                                     const std::vector<std::string>& encoders) {
  if (options.width % 2 != 0 || options.height % 2 != 0)
    throw UsageError(path + ": the sides of an MP4 are even, " + std::to_string(options.width) + "x" +
                     std::to_string(options.height) + " is not; take " +
                     std::to_string(options.width + options.width % 2) + "x" +
                     std::to_string(options.height + options.height % 2));
  if (options.transparent)
    throw UsageError(path + ": MP4 has no transparency; give a background, or write .gif, .webp or a folder");
  return std::make_unique<Mp4>(path, options, encoders);
}

}  // namespace skel
