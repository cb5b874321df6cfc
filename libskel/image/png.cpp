#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <new>
#include <vector>

#include "libskel/core/check.h"
#include "libskel/core/error.h"
#include "libskel/image/formats.h"
#include "libskel/image/write_image.h"

namespace skel {
namespace {

// libpng leaves by longjmp: functions that call setjmp own nothing that has a destructor.
struct Session {
  char message[160] = "";
  const png_byte* next = nullptr;  // reading
  std::size_t left = 0;
  std::string* written = nullptr;  // writing
};

void onError(png_structp png, png_const_charp message) {
  auto* session = static_cast<Session*>(png_get_error_ptr(png));
  std::snprintf(session->message, sizeof session->message, "%s", message);
  png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

void onRead(png_structp png, png_bytep out, std::size_t size) {
  auto* session = static_cast<Session*>(png_get_io_ptr(png));
  if (session->left < size) png_error(png, "it ends too early");
  std::memcpy(out, session->next, size);
  session->next += size;
  session->left -= size;
}

void onWrite(png_structp png, png_bytep data, std::size_t size) {
  static_cast<Session*>(png_get_io_ptr(png))->written->append(reinterpret_cast<const char*>(data), size);
}

void onFlush(png_structp) {}

// Whether all chunks lie in the file: libpng takes the memory that one claims before it looks.
bool hasAllChunks(std::string_view bytes) {
  for (std::size_t at = 8; at + 12 <= bytes.size();) {  // length, type, content, checksum
    const std::size_t left = bytes.size() - at - 12;
    const std::size_t length = png_get_uint_32(reinterpret_cast<png_const_bytep>(bytes.data() + at));
    if (length > left) return false;
    if (bytes.substr(at + 4, 4) == "IEND") return true;
    at += 12 + length;
  }
  return false;
}

struct Header {
  png_uint_32 width = 0, height = 0;
  std::size_t stored_bytes = 0;  // of the rows, as they are in the file
};

bool readHeader(png_structp png, png_infop info, Header* header) {
  if (setjmp(png_jmpbuf(png))) return false;
  // Sizes are checked by the caller, before anything of that size is allocated.
  png_set_user_limits(png, 0x7fffffff, 0x7fffffff);
  // A few kB of compressed text, which we never look at, unpack to 8 MB.
  png_set_chunk_cache_max(png, 8);
  png_read_info(png, info);
  header->width = png_get_image_width(png, info);
  header->height = png_get_image_height(png, info);
  header->stored_bytes = png_get_rowbytes(png, info) * header->height;
  return true;
}

bool readPixels(png_structp png, png_infop info, png_bytepp rows, std::size_t row_bytes) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_expand(png);
  png_set_scale_16(png);
  png_set_gray_to_rgb(png);
  png_set_add_alpha(png, 0xff, PNG_FILLER_AFTER);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  if (png_get_rowbytes(png, info) != row_bytes) png_error(png, "its rows have another length than stated");
  png_read_image(png, rows);
  png_read_end(png, info);
  return true;
}

int orientationOf(png_structp png, png_infop info) {
  png_uint_32 size = 0;
  png_bytep exif = nullptr;
  if (png_get_eXIf_1(png, info, &size, &exif) == 0) return 1;
  return tiffOrientation({reinterpret_cast<const char*>(exif), size});
}

bool write(png_structp png, png_infop info, int width, int height, int color_type, int compression,
           int filters, png_bytepp rows) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_compression_level(png, compression);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, filters);
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), 8, color_type,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  if (color_type == PNG_COLOR_TYPE_RGB) png_set_filler(png, 0, PNG_FILLER_AFTER);
  png_write_image(png, rows);
  png_write_end(png, info);
  return true;
}

std::string encode(const std::uint8_t* pixels, int width, int height, int channels, int color_type,
                   int compression, int filters) {
  SKEL_CHECK(width > 0 && height > 0);
  std::vector<png_bytep> rows(static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    rows[y] = const_cast<png_bytep>(pixels) + std::int64_t{y} * width * channels;
  }
  std::string bytes;
  Session session;
  session.written = &bytes;
  struct Writer {
    png_structp png = nullptr;
    png_infop info = nullptr;
    ~Writer() { png_destroy_write_struct(&png, &info); }
  } writer;
  writer.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &session, onError, onWarning);
  if (writer.png) writer.info = png_create_info_struct(writer.png);
  if (!writer.info) throw std::bad_alloc();
  png_set_write_fn(writer.png, &session, onWrite, onFlush);
  // Pictures are right and strings take all bytes: memory alone can be missing.
  if (!write(writer.png, writer.info, width, height, color_type, compression, filters, rows.data()))
    throw std::bad_alloc();
  return bytes;
}

}  // namespace

Image decodePng(std::string_view bytes, const std::string& file) {
  Session session;
  session.next = reinterpret_cast<const png_byte*>(bytes.data());
  session.left = bytes.size();
  struct Reader {
    png_structp png = nullptr;
    png_infop info = nullptr;
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  } reader;
  reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &session, onError, onWarning);
  if (reader.png != nullptr) reader.info = png_create_info_struct(reader.png);
  SKEL_CHECK(reader.info != nullptr);
  png_set_read_fn(reader.png, &session, onRead);

  const auto broken = [&]() -> InputError {
    return {file, "is a broken PNG (" + std::string(session.message) + "); export it again"};
  };
  if (!hasAllChunks(bytes)) throw InputError(file, "is a broken PNG (it ends too early); export it again");
  Header header;
  if (!readHeader(reader.png, reader.info, &header)) throw broken();
  checkSize(header.width, header.height, file);
  // Deflate packs at most 1032 bytes into one: a file too short for its size is not worth the memory.
  if (header.stored_bytes / 1032 > bytes.size()) {
    std::snprintf(session.message, sizeof session.message, "it ends too early");
    throw broken();
  }

  Image image(static_cast<int>(header.width), static_cast<int>(header.height));
  const std::size_t row_bytes = std::size_t{header.width} * 4;
  std::vector<png_bytep> rows(header.height);
  for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = image.rgba.data() + y * row_bytes;
  if (!readPixels(reader.png, reader.info, rows.data(), row_bytes)) throw broken();
  return oriented(std::move(image), orientationOf(reader.png, reader.info));
}

std::string encodePng(const Image& image, int compression) {
  const bool opaque = (image.rgba.col(3) == 255).all();
  return encode(image.rgba.data(), image.width, image.height, 4,
                opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, compression, PNG_FILTER_UP);
}

std::string encodePng(const Plane8& plane, int compression) {
  return encode(plane.data(), static_cast<int>(plane.cols()), static_cast<int>(plane.rows()), 1,
                PNG_COLOR_TYPE_GRAY, compression, PNG_FILTER_NONE);
}

}  // namespace skel
