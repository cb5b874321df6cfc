#include "libskel/image/write_jpeg.h"

// jpeglib.h needs these two first.
#include <cstddef>
#include <cstdio>
// clang-format off
#include <jpeglib.h>
// clang-format on

#include <csetjmp>
#include <cstdlib>
#include <new>

#include "libskel/core/check.h"

namespace skel {
namespace {

// libjpeg leaves by longjmp, for want of memory alone: who calls setjmp owns nothing that has a destructor.
struct JpegWriter {
  jpeg_compress_struct jpeg;
  jpeg_error_mgr errors;
  std::jmp_buf leave;
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
};

void onWriteError(j_common_ptr jpeg) { std::longjmp(static_cast<JpegWriter*>(jpeg->client_data)->leave, 1); }

bool writeJpeg(JpegWriter* writer, const Image* image, int quality) {
  if (setjmp(writer->leave)) return false;
  jpeg_create_compress(&writer->jpeg);
  writer->jpeg.client_data = writer;
  jpeg_mem_dest(&writer->jpeg, &writer->bytes, &writer->size);
  writer->jpeg.image_width = static_cast<JDIMENSION>(image->width);
  writer->jpeg.image_height = static_cast<JDIMENSION>(image->height);
  writer->jpeg.input_components = 4;
  writer->jpeg.in_color_space = JCS_EXT_RGBX;
  jpeg_set_defaults(&writer->jpeg);
  jpeg_set_quality(&writer->jpeg, quality, TRUE);
  writer->jpeg.optimize_coding = TRUE;
  jpeg_start_compress(&writer->jpeg, TRUE);
  while (writer->jpeg.next_scanline < writer->jpeg.image_height) {
    JSAMPROW row = const_cast<JSAMPROW>(image->pixel(0, static_cast<int>(writer->jpeg.next_scanline)));
    jpeg_write_scanlines(&writer->jpeg, &row, 1);
  }
  jpeg_finish_compress(&writer->jpeg);
  return true;
}

}  // namespace

std::optional<std::string> encodeJpeg(const Image& image, int quality) {
  SKEL_CHECK(!image.empty());
  JpegWriter writer{};
  writer.jpeg.err = jpeg_std_error(&writer.errors);
  writer.jpeg.client_data = &writer;
  writer.errors.error_exit = onWriteError;
  const bool written = writeJpeg(&writer, &image, quality);
  std::optional<std::string> bytes;
  if (written) bytes.emplace(reinterpret_cast<const char*>(writer.bytes), writer.size);
  jpeg_destroy_compress(&writer.jpeg);
  std::free(writer.bytes);
  if (!written) throw std::bad_alloc();
  return bytes;
}

}  // namespace skel
