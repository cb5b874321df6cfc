// jpeglib.h needs these two first.
#include <cstddef>
#include <cstdio>
// clang-format off
#include <jpeglib.h>
#include <jerror.h>
// clang-format on

#include <algorithm>
#include <csetjmp>
#include <string>

#include "libskel/core/error.h"
#include "libskel/core/file_names.h"
#include "libskel/image/formats.h"

namespace skel {
namespace {

// libjpeg leaves by longjmp: functions that call setjmp own nothing that has a destructor.
struct Session {
  jpeg_decompress_struct jpeg;
  jpeg_error_mgr errors;
  jpeg_progress_mgr progress;
  std::jmp_buf leave;
  char message[JMSG_LENGTH_MAX] = "";
};

Session* sessionOf(j_common_ptr jpeg) { return static_cast<Session*>(jpeg->client_data); }

void onError(j_common_ptr jpeg) {
  Session* session = sessionOf(jpeg);
  jpeg->err->format_message(jpeg, session->message);
  std::longjmp(session->leave, 1);
}

void onMessage(j_common_ptr jpeg, int level) {
  const int code = jpeg->err->msg_code;
  if (level >= 0 || (code != JWRN_JPEG_EOF && code != JWRN_HIT_MARKER)) return;
  // At once: a short file may promise a large picture.
  Session* session = sessionOf(jpeg);
  std::snprintf(session->message, sizeof session->message, "it ends too early");
  std::longjmp(session->leave, 1);
}

// A small file may ask for thousands of passes over a large picture. Programs write about ten.
void onProgress(j_common_ptr jpeg) {
  constexpr double kMaxScans = 100, kMaxScannedPixels = 1.6e9;
  Session* session = sessionOf(jpeg);
  const double pixels = double(session->jpeg.image_width) * double(session->jpeg.image_height);
  const int most = static_cast<int>(std::min(kMaxScans, kMaxScannedPixels / pixels));
  if (session->jpeg.input_scan_number <= most) return;
  std::snprintf(session->message, sizeof session->message, "more than %d scans", most);
  std::longjmp(session->leave, 1);
}

bool readHeader(Session* session, std::string_view bytes) {
  if (setjmp(session->leave)) return false;
  jpeg_create_decompress(&session->jpeg);
  session->jpeg.client_data = session;
  session->jpeg.progress = &session->progress;
  jpeg_mem_src(&session->jpeg, reinterpret_cast<const unsigned char*>(bytes.data()),
               static_cast<unsigned long>(bytes.size()));
  jpeg_save_markers(&session->jpeg, JPEG_APP0 + 1, 0xffff);
  jpeg_read_header(&session->jpeg, TRUE);
  return true;
}

bool readPixels(Session* session, std::uint8_t* rgba) {
  if (setjmp(session->leave)) return false;
  session->jpeg.out_color_space = JCS_EXT_RGBA;
  jpeg_start_decompress(&session->jpeg);
  while (session->jpeg.output_scanline < session->jpeg.output_height) {
    JSAMPROW row = rgba + std::size_t{session->jpeg.output_scanline} * session->jpeg.output_width * 4;
    jpeg_read_scanlines(&session->jpeg, &row, 1);
  }
  jpeg_finish_decompress(&session->jpeg);
  return true;
}

int orientationOf(const jpeg_decompress_struct& jpeg) {
  for (const jpeg_marker_struct* marker = jpeg.marker_list; marker != nullptr; marker = marker->next) {
    const std::string_view data(reinterpret_cast<const char*>(marker->data), marker->data_length);
    if (data.starts_with(std::string_view("Exif\0\0", 6))) return tiffOrientation(data.substr(6));
  }
  return 1;
}

}  // namespace

Image decodeJpeg(std::string_view bytes, const std::string& file) {
  struct Reader : Session {
    Reader() : Session{} {
      jpeg.err = jpeg_std_error(&errors);
      jpeg.client_data = static_cast<Session*>(this);
      errors.error_exit = onError;
      errors.emit_message = onMessage;
      progress.progress_monitor = onProgress;
    }
    ~Reader() { jpeg_destroy_decompress(&jpeg); }
  } reader;

  const auto broken = [&]() -> InputError {
    return {file, "is a broken JPEG (" + std::string(reader.message) + "); export it again"};
  };
  if (!readHeader(&reader, bytes)) throw broken();
  checkSize(reader.jpeg.image_width, reader.jpeg.image_height, file);
  const J_COLOR_SPACE space = reader.jpeg.jpeg_color_space;
  if (space == JCS_CMYK || space == JCS_YCCK) {
    throw InputError(file, "is a CMYK JPEG, made for printing; convert it to RGB, for example by `magick " +
                               shellWord(file) + " -colorspace sRGB out.png`");
  }
  const int orientation = orientationOf(reader.jpeg);  // the markers are gone once the pixels are read
  Image image(static_cast<int>(reader.jpeg.image_width), static_cast<int>(reader.jpeg.image_height));
  if (!readPixels(&reader, image.rgba.data())) throw broken();
  return oriented(std::move(image), orientation);
}

}  // namespace skel
