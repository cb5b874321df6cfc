#include <gif_lib.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <mutex>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>

#include "libskel/image/plugin/codec.h"

namespace {

struct Source {
  const std::uint8_t* next;
  std::size_t left;
};

int readGifBytes(GifFileType* gif, GifByteType* out, int size) {
  auto* source = static_cast<Source*>(gif->UserData);
  const std::size_t count = std::min(source->left, static_cast<std::size_t>(size));
  std::memcpy(out, source->next, count);
  source->next += count;
  source->left -= count;
  return static_cast<int>(count);
}

// The first frame on the canvas; what it does not cover is transparent.
cv::Mat decodeGif(const std::uint8_t* bytes, std::size_t size) {
  Source source{bytes, size};
  struct Reader {
    GifFileType* gif;
    ~Reader() {
      if (gif) DGifCloseFile(gif, nullptr);
    }
  } reader{DGifOpen(&source, readGifBytes, nullptr)};
  GifFileType* gif = reader.gif;
  const auto require = [](bool good) {
    if (!good) throw std::runtime_error("its GIF data is damaged");
  };
  require(gif != nullptr);
  int transparent = NO_TRANSPARENT_COLOR;
  for (;;) {
    GifRecordType type;
    require(DGifGetRecordType(gif, &type) == GIF_OK);
    if (type == EXTENSION_RECORD_TYPE) {
      int code;
      GifByteType* block;
      require(DGifGetExtension(gif, &code, &block) == GIF_OK);
      GraphicsControlBlock control;
      if (code == GRAPHICS_EXT_FUNC_CODE && block &&
          DGifExtensionToGCB(block[0], block + 1, &control) == GIF_OK) {
        transparent = control.TransparentColor;
      }
      while (block) require(DGifGetExtensionNext(gif, &block) == GIF_OK);
      continue;
    }
    require(type == IMAGE_DESC_RECORD_TYPE && DGifGetImageDesc(gif) == GIF_OK);
    break;
  }
  const GifImageDesc& frame = gif->Image;
  const ColorMapObject* colors = frame.ColorMap ? frame.ColorMap : gif->SColorMap;
  require(colors != nullptr && frame.Left >= 0 && frame.Top >= 0 && frame.Width > 0 && frame.Height > 0 &&
          frame.Left + frame.Width <= gif->SWidth && frame.Top + frame.Height <= gif->SHeight);
  cv::Mat canvas = cv::Mat::zeros(gif->SHeight, gif->SWidth, CV_8UC4);
  const auto readRow = [&](int y) {
    cv::AutoBuffer<GifPixelType> row(frame.Width);
    require(DGifGetLine(gif, row.data(), frame.Width) == GIF_OK);
    for (int x = 0; x < frame.Width; ++x) {
      const int index = row[x];
      if (index == transparent) continue;
      require(index < colors->ColorCount);
      const GifColorType& c = colors->Colors[index];
      canvas.at<cv::Vec4b>(frame.Top + y, frame.Left + x) = {c.Red, c.Green, c.Blue, 255};
    }
  };
  if (frame.Interlace) {
    const int starts[] = {0, 4, 2, 1}, steps[] = {8, 8, 4, 2};
    for (int pass = 0; pass < 4; ++pass) {
      for (int y = starts[pass]; y < frame.Height; y += steps[pass]) readRow(y);
    }
  } else {
    for (int y = 0; y < frame.Height; ++y) readRow(y);
  }
  return canvas;
}

// imdecode() prints each failure, which is the caller's to report.
class QuietErrors {
 public:
  QuietErrors() : lock_(mutex()), screen_(std::cerr.rdbuf(dropped_.rdbuf())) {}
  ~QuietErrors() { std::cerr.rdbuf(screen_); }

 private:
  static std::mutex& mutex() {
    static std::mutex mutex;
    return mutex;
  }
  std::lock_guard<std::mutex> lock_;
  std::ostringstream dropped_;
  std::streambuf* screen_;
};

cv::Mat decodeOther(const std::uint8_t* bytes, std::size_t size) {
  const cv::Mat buffer(1, static_cast<int>(size), CV_8U, const_cast<std::uint8_t*>(bytes));
  const QuietErrors quiet;
  cv::Mat picture = cv::imdecode(buffer, cv::IMREAD_UNCHANGED);
  if (picture.empty()) throw std::runtime_error("it ends too early or its data is damaged");
  if (picture.depth() == CV_16U) {
    picture.convertTo(picture, CV_8U, 1.0 / 257);
  } else if (picture.depth() != CV_8U) {
    throw std::runtime_error("its pixels are no whole numbers of 8 or 16 bits");
  }
  cv::Mat rgba;
  switch (picture.channels()) {
    case 1:
      cv::cvtColor(picture, rgba, cv::COLOR_GRAY2RGBA);
      break;
    case 3:
      cv::cvtColor(picture, rgba, cv::COLOR_BGR2RGBA);
      break;
    case 4:
      cv::cvtColor(picture, rgba, cv::COLOR_BGRA2RGBA);
      break;
    default:
      throw std::runtime_error("it has " + std::to_string(picture.channels()) + " channels");
  }
  return rgba;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) int skelDecode1(const std::uint8_t* bytes, std::size_t size,
                                                                  int* width, int* height,
                                                                  std::uint8_t** rgba, char* message,
                                                                  std::size_t message_size) {
  try {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    const bool gif = size >= 4 && std::memcmp(bytes, "GIF8", 4) == 0;
    const cv::Mat picture = gif ? decodeGif(bytes, size) : decodeOther(bytes, size);
    const std::size_t count = picture.total() * 4;
    *rgba = static_cast<std::uint8_t*>(std::malloc(count));
    if (*rgba == nullptr) throw std::bad_alloc();
    std::memcpy(*rgba, picture.data, count);
    *width = picture.cols;
    *height = picture.rows;
    return 1;
  } catch (const std::exception& failure) {
    std::snprintf(message, message_size, "%s", failure.what());
    return 0;
  }
}
