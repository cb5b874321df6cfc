// Films through FFmpeg's libraries.
#include <cerrno>
#include <cmath>
#include <memory>
#include <new>

#include "libskel/core/error.h"
#include "libskel/core/input_guard.h"
#include "libskel/image/formats.h"
#include "libskel/image/read_image.h"
#include "libskel/video/formats.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

namespace skel {
namespace {

constexpr double kUsualFrameRate = 25;

// Containers of films. The others that FFmpeg knows are play lists and devices, which open other things.
constexpr const char* kContainers =
    "apng,asf,avi,flv,gif,h264,hevc,ivf,m4v,matroska,mov,mpeg,mpegts,mpegvideo,mxf,nut,obu,ogg,yuv4mpegpipe";

struct Free {
  void operator()(AVFormatContext* file) const { avformat_close_input(&file); }
  void operator()(AVCodecContext* decoder) const { avcodec_free_context(&decoder); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
};
template <class T>
using Owned = std::unique_ptr<T, Free>;

class FilmReader : public VideoReader {
 public:
  explicit FilmReader(const std::string& path) : path_(path) {
    av_log_set_level(AV_LOG_QUIET);
    AVFormatContext* file = nullptr;
    AVDictionary* only = nullptr;
    av_dict_set(&only, "protocol_whitelist", "file", 0);
    av_dict_set(&only, "format_whitelist", kContainers, 0);
    // Without the protocol, "take:1.mp4" would be an address.
    const int opened = avformat_open_input(&file, ("file:" + path).c_str(), nullptr, &only);
    av_dict_free(&only);
    if (opened == AVERROR(EINVAL))  // a format that is not on the list
      throw InputError(path_, "cannot be read as a film: it is no MP4, WebM, MKV, AVI, GIF ...");
    require(opened);
    file_.reset(file);
    noteInput(path);
    require(avformat_find_stream_info(file, nullptr));
    const AVCodec* codec = nullptr;
    stream_ = av_find_best_stream(file, AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
    if (stream_ < 0 || !codec) throw InputError(path_, "holds no film that FFmpeg can read here");
    decoder_.reset(avcodec_alloc_context3(codec));
    packet_.reset(av_packet_alloc());
    frame_.reset(av_frame_alloc());
    if (!decoder_ || !packet_ || !frame_) throw std::bad_alloc();
    const AVStream& stream = *file->streams[stream_];
    require(avcodec_parameters_to_context(decoder_.get(), stream.codecpar));
    if (decoder_->width > 0) checkFrameSize(decoder_->width, decoder_->height, path_);
    decoder_->max_pixels = kMostFramePixels;
    require(avcodec_open2(decoder_.get(), codec, nullptr));
    const double rate = av_q2d(stream.avg_frame_rate.num > 0 ? stream.avg_frame_rate : stream.r_frame_rate);
    frame_rate_ = rate > 0 && rate < 1000 ? rate : kUsualFrameRate;
  }

  bool next(VideoFrame& out) override {
    if (!decode()) {
      if (count_ == 0) throw InputError(path_, "holds a film without frames");
      return false;
    }
    if (count_ == 0) {
      width_ = frame_->width, height_ = frame_->height;
      checkFrameSize(width_, height_, path_);
    }
    if (frame_->width != width_ || frame_->height != height_)
      throw InputError(path_, "changes the size of its frames at frame " + std::to_string(count_ + 1));
    // What there was is freed or used again.
    scaler_.reset(sws_getCachedContext(
        scaler_.release(), width_, height_, static_cast<AVPixelFormat>(frame_->format), width_, height_,
        AV_PIX_FMT_RGBA, SWS_BILINEAR | SWS_ACCURATE_RND, nullptr, nullptr, nullptr));
    if (!scaler_) throw InputError(path_, "has colours that FFmpeg cannot convert");
    out.image = Image(width_, height_);
    std::uint8_t* rows[] = {out.image.rgba.data()};
    const int row_bytes[] = {4 * width_};
    sws_scale(scaler_.get(), frame_->data, frame_->linesize, 0, height_, rows, row_bytes);
    out.image = shrunk(std::move(out.image));
    out.file.clear();
    const AVRational unit = file_->streams[stream_]->time_base;
    const std::int64_t stamp = frame_->best_effort_timestamp;
    if (count_ == 0) first_ = stamp;
    const double least = count_ == 0 ? 0 : time_s_ + 1e-4;
    time_s_ = stamp == AV_NOPTS_VALUE || first_ == AV_NOPTS_VALUE
                  ? count_ / frame_rate_
                  : (static_cast<double>(stamp) - static_cast<double>(first_)) * av_q2d(unit);
    time_s_ = std::max(time_s_, least);
    out.time_s = time_s_;
    ++count_;
    return true;
  }

 private:
  void require(int result) const {
    if (result >= 0) return;
    char why[AV_ERROR_MAX_STRING_SIZE] = "";
    av_strerror(result, why, sizeof why);
    throw InputError(path_, std::string("cannot be read as a film: ") + why);
  }

  bool decode() {
    for (;;) {
      const int got = avcodec_receive_frame(decoder_.get(), frame_.get());
      if (got >= 0) return true;
      if (got == AVERROR_EOF) return false;
      if (got != AVERROR(EAGAIN)) require(got);
      const int read = av_read_frame(file_.get(), packet_.get());
      if (read == AVERROR_EOF) {
        require(avcodec_send_packet(decoder_.get(), nullptr));
        continue;
      }
      require(read);
      if (packet_->stream_index == stream_) {
        const int sent = avcodec_send_packet(decoder_.get(), packet_.get());
        av_packet_unref(packet_.get());
        require(sent);
      } else {
        av_packet_unref(packet_.get());
      }
    }
  }

  std::string path_;
  Owned<AVFormatContext> file_;
  Owned<AVCodecContext> decoder_;
  Owned<AVPacket> packet_;
  Owned<AVFrame> frame_;
  Owned<SwsContext> scaler_;
  int stream_ = -1, width_ = 0, height_ = 0, count_ = 0;
  std::int64_t first_ = 0;
  double time_s_ = 0;
};

}  // namespace

std::unique_ptr<VideoReader> readFilm(const std::string& path) { return std::make_unique<FilmReader>(path); }

}  // namespace skel
