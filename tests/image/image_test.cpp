#include <png.h>
#include <sys/resource.h>
#include <zlib.h>

#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <vector>
// clang-format off
#include <jpeglib.h>
// clang-format on

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/rng.h"
#include "libskel/image/read_image.h"
#include "libskel/image/sealed_png.h"
#include "libskel/image/write_image.h"
#include "tests/support/catch.h"
#include "tests/support/temp_dir.h"

using namespace skel;
using Catch::Matchers::Contains;

namespace {

using Bytes = std::vector<std::uint8_t>;

long peak_kB() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

// A PNG with rows given as they are stored; 16-bit samples are big-endian.
std::string makePng(int width, int height, int depth, int color_type, const Bytes& rows,
                    bool interlaced = false, const std::vector<png_color>& palette = {},
                    const Bytes& palette_alpha = {}, const png_color_16* transparent = nullptr) {
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp p, png_bytep data, png_size_t size) {
        static_cast<std::string*>(png_get_io_ptr(p))->append(reinterpret_cast<char*>(data), size);
      },
      [](png_structp) {});
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), depth,
               color_type, interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (!palette.empty()) png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
  if (!palette_alpha.empty()) {
    png_set_tRNS(png, info, palette_alpha.data(), static_cast<int>(palette_alpha.size()), nullptr);
  }
  if (transparent) png_set_tRNS(png, info, nullptr, 0, transparent);
  png_write_info(png, info);
  const size_t stride = rows.size() / static_cast<size_t>(height);
  std::vector<png_bytep> pointers;
  for (int y = 0; y < height; ++y) pointers.push_back(const_cast<png_bytep>(rows.data()) + y * stride);
  png_write_image(png, pointers.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

std::string makeJpeg(int width, int height, int channels, const Bytes& samples, int orientation = 0,
                     bool progressive = false) {
  jpeg_compress_struct jpeg;
  jpeg_error_mgr errors;
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* out = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &out, &size);
  jpeg.image_width = static_cast<JDIMENSION>(width);
  jpeg.image_height = static_cast<JDIMENSION>(height);
  jpeg.input_components = channels;
  jpeg.in_color_space = channels == 1 ? JCS_GRAYSCALE : channels == 3 ? JCS_RGB : JCS_CMYK;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 100, TRUE);
  if (progressive) jpeg_simple_progression(&jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  if (orientation > 0) {
    Bytes exif = {'E', 'x', 'i', 'f', 0,    0, 'M', 'M', 0, 42, 0, 0, 0,
                  8,   0,   1,   1,   0x12, 0, 3,   0,   0, 0,  1, 0, static_cast<std::uint8_t>(orientation),
                  0,   0,   0,   0,   0,    0};
    jpeg_write_marker(&jpeg, JPEG_APP0 + 1, exif.data(), static_cast<unsigned>(exif.size()));
  }
  for (int y = 0; y < height; ++y) {
    auto* row = const_cast<JSAMPROW>(samples.data()) + std::size_t{1} * y * width * channels;
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  std::string bytes(reinterpret_cast<char*>(out), size);
  std::free(out);
  return bytes;
}

Bytes pixel(const Image& image, int x, int y) { return {image.pixel(x, y), image.pixel(x, y) + 4}; }

std::string complaint(const std::string& bytes, const std::string& file = "x") {
  try {
    decodeImage(bytes, file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("PNG: every depth and colour type becomes 8-bit RGBA") {
  const bool interlaced = GENERATE(false, true);
  const auto decode = [&](int width, int depth, int type, const Bytes& rows) {
    return decodeImage(makePng(width, 1, depth, type, rows, interlaced), "x.png");
  };
  const Image one = decode(8, 1, PNG_COLOR_TYPE_GRAY, {0b10100000});
  CHECK(pixel(one, 0, 0) == Bytes{255, 255, 255, 255});
  CHECK(pixel(one, 1, 0) == Bytes{0, 0, 0, 255});
  CHECK(pixel(decode(4, 2, PNG_COLOR_TYPE_GRAY, {0b00011011}), 1, 0) == Bytes{85, 85, 85, 255});
  CHECK(pixel(decode(2, 4, PNG_COLOR_TYPE_GRAY, {0x3f}), 0, 0) == Bytes{51, 51, 51, 255});
  CHECK(pixel(decode(1, 8, PNG_COLOR_TYPE_GRAY, {7}), 0, 0) == Bytes{7, 7, 7, 255});
  CHECK(pixel(decode(1, 16, PNG_COLOR_TYPE_GRAY, {0x80, 0x80}), 0, 0) == Bytes{128, 128, 128, 255});
  CHECK(pixel(decode(1, 8, PNG_COLOR_TYPE_GRAY_ALPHA, {7, 9}), 0, 0) == Bytes{7, 7, 7, 9});
  CHECK(pixel(decode(1, 16, PNG_COLOR_TYPE_GRAY_ALPHA, {7, 7, 9, 9}), 0, 0) == Bytes{7, 7, 7, 9});
  CHECK(pixel(decode(1, 8, PNG_COLOR_TYPE_RGB, {1, 2, 3}), 0, 0) == Bytes{1, 2, 3, 255});
  CHECK(pixel(decode(1, 16, PNG_COLOR_TYPE_RGB, {1, 1, 2, 2, 3, 3}), 0, 0) == Bytes{1, 2, 3, 255});
  CHECK(pixel(decode(1, 8, PNG_COLOR_TYPE_RGB_ALPHA, {1, 2, 3, 4}), 0, 0) == Bytes{1, 2, 3, 4});
  CHECK(pixel(decode(1, 16, PNG_COLOR_TYPE_RGB_ALPHA, {1, 1, 2, 2, 3, 3, 4, 4}), 0, 0) == Bytes{1, 2, 3, 4});
}

TEST_CASE("PNG: palettes, transparent entries and the transparent colour") {
  const std::vector<png_color> palette = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  const int depth = GENERATE(2, 4, 8);
  const Bytes row = depth == 2 ? Bytes{0b00011000} : depth == 4 ? Bytes{0x01, 0x20} : Bytes{0, 1, 2};
  const Image image =
      decodeImage(makePng(3, 1, depth, PNG_COLOR_TYPE_PALETTE, row, false, palette, {0, 100}), "x.png");
  CHECK(pixel(image, 0, 0) == Bytes{1, 2, 3, 0});
  CHECK(pixel(image, 1, 0) == Bytes{4, 5, 6, 100});
  CHECK(pixel(image, 2, 0) == Bytes{7, 8, 9, 255});

  png_color_16 key = {};
  key.gray = 3;
  const Image grey = decodeImage(makePng(2, 1, 8, PNG_COLOR_TYPE_GRAY, {3, 4}, false, {}, {}, &key), "x.png");
  CHECK(pixel(grey, 0, 0) == Bytes{3, 3, 3, 0});
  CHECK(pixel(grey, 1, 0) == Bytes{4, 4, 4, 255});
}

TEST_CASE("PNG: an interlaced picture is the same as a plain one") {
  Bytes rows;
  for (int i = 0; i < 13 * 11 * 3; ++i) rows.push_back(static_cast<std::uint8_t>(i * 37));
  const Image plain = decodeImage(makePng(13, 11, 8, PNG_COLOR_TYPE_RGB, rows), "a");
  const Image interlaced = decodeImage(makePng(13, 11, 8, PNG_COLOR_TYPE_RGB, rows, true), "b");
  CHECK((plain.rgba == interlaced.rgba).all());
}

TEST_CASE("PNG: what is written is read back") {
  Image image(5, 3);
  for (Eigen::Index i = 0; i < image.rgba.size(); ++i)
    image.rgba.data()[i] = static_cast<std::uint8_t>(i * 7);
  const Image back = decodeImage(encodePng(image), "x");
  CHECK(back.width == 5);
  CHECK(back.height == 3);
  CHECK((back.rgba == image.rgba).all());

  image.rgba.col(3) = 255;
  const std::string opaque = encodePng(image);
  CHECK(opaque[25] == PNG_COLOR_TYPE_RGB);
  CHECK((decodeImage(opaque, "x").rgba == image.rgba).all());

  Plane8 plane(2, 3);
  plane << 0, 127, 128, 255, 1, 254;
  const std::string grey = encodePng(plane);
  CHECK(pixel(decodeImage(grey, "x"), 1, 0) == Bytes{127, 127, 127, 255});
  CHECK(encodePng(plane) == grey);
}

TEST_CASE("a sealed PNG tells whether somebody has painted in it") {
  Image image(7, 5);
  image.rgba.setConstant(150);
  image.pixel(2, 3)[0] = 9;
  const std::string sealed = encodeSealedPng(image);
  CHECK((decodeImage(sealed, "a.png").rgba == image.rgba).all());  // libpng holds its checksum against it
  CHECK(isAsSealed(sealed));
  // Painted, by a program that drops texts and by one that keeps them.
  const std::string plain = encodePng(image), seal = sealed.substr(33, sealed.size() - plain.size());
  CHECK_FALSE(isAsSealed(plain));
  CHECK(sealed.substr(0, 33) + seal + plain.substr(33) == sealed);
  image.pixel(2, 3)[0] = 10;
  const std::string painted = encodePng(image);
  CHECK_FALSE(isAsSealed(painted.substr(0, 33) + seal + painted.substr(33)));
  CHECK_FALSE(isAsSealed(sealed.substr(0, sealed.size() / 2)));
  CHECK_FALSE(isAsSealed("no picture"));
}

TEST_CASE("a mask is what is light and opaque") {
  const TempDir dir;
  const std::string path = dir.file("mask.png");
  writeFile(path, makePng(4, 1, 8, PNG_COLOR_TYPE_GRAY_ALPHA, {127, 255, 128, 255, 255, 127, 255, 128}));
  const Plane8 mask = readMask(path);
  CHECK(mask.rows() == 1);
  CHECK(std::vector<int>(mask.data(), mask.data() + 4) == std::vector<int>{0, 255, 0, 255});
}

TEST_CASE("PNG: every truncation and no flipped byte gets through as a crash") {
  Bytes rows;
  for (int i = 0; i < 16 * 16 * 3; ++i) rows.push_back(static_cast<std::uint8_t>(i * i * 31));
  const std::string whole = makePng(16, 16, 8, PNG_COLOR_TYPE_RGB, rows);
  for (size_t size = 8; size < whole.size(); size += size < 64 ? 1 : 17) {
    CHECK_THAT(complaint(whole.substr(0, size), "cut.png"), Contains("cut.png: is a broken PNG"));
  }
  int refused = 0;
  for (size_t i = 8; i < whole.size(); ++i) {
    std::string bytes = whole;
    bytes[i] = static_cast<char>(bytes[i] ^ 0x5a);
    refused += complaint(bytes) != "none";
  }
  CHECK(refused > static_cast<int>(whole.size()) * 9 / 10);
}

TEST_CASE("a size that cannot be meant is refused before memory is taken") {
  std::string png = makePng(1, 1, 8, PNG_COLOR_TYPE_RGB, {1, 2, 3});
  // 60000×60000 with the checksum that belongs to it.
  const Bytes header = {0, 0, 0, 13, 'I', 'H', 'D', 'R', 0, 0, 0xea, 0x60, 0, 0, 0xea, 0x60, 8, 2, 0, 0, 0};
  std::uint32_t crc = 0xffffffff;
  for (size_t i = 4; i < header.size(); ++i) {
    crc ^= header[i];
    for (int k = 0; k < 8; ++k) crc = crc & 1 ? 0xedb88320 ^ (crc >> 1) : crc >> 1;
  }
  crc = ~crc;
  std::string large(header.begin(), header.end());
  for (int shift = 24; shift >= 0; shift -= 8) large += static_cast<char>(crc >> shift);
  png.replace(8, large.size(), large);
  CHECK_THAT(complaint(png, "big.png"), Contains("big.png: is too large: 60000x60000 px"));

  std::string jpeg = makeJpeg(8, 8, 3, Bytes(192, 9));
  const size_t frame = jpeg.find("\xff\xc0");
  for (size_t i : {5, 7}) jpeg.replace(frame + i, 2, "\xea\x60");
  CHECK_THAT(complaint(jpeg, "big.jpg"), Contains("big.jpg: is too large: 60000x60000 px"));

  std::string bmp = "BM" + std::string(60, '\0');
  bmp[14] = 40;
  for (size_t i : {18, 22}) bmp.replace(i, 2, "\x60\xea");
  CHECK_THAT(complaint(bmp, "big.bmp"), Contains("big.bmp: is too large: 60000x60000 px"));
}

TEST_CASE("PNG: a header that promises more than the file can hold is refused") {
  std::string bytes = makePng(9000, 9000, 1, PNG_COLOR_TYPE_GRAY, Bytes(9000 * 1125));
  CHECK(decodeImage(bytes, "x").width == 9000);
  CHECK_THAT(complaint(bytes.substr(0, 2000)), Contains("ends too early"));
}

TEST_CASE("PNG: packed text takes no memory") {
  const auto number = [](unsigned long value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
    return bytes;
  };
  const std::string text(7'900'000, 'a');
  std::string packed(20'000, '\0');
  uLongf size = packed.size();
  REQUIRE(compress(reinterpret_cast<Bytef*>(packed.data()), &size,
                   reinterpret_cast<const Bytef*>(text.data()), text.size()) == Z_OK);
  std::string chunk = "zTXtkey";
  chunk += std::string(2, '\0') + packed.substr(0, size);
  const auto crc = crc32(0, reinterpret_cast<const Bytef*>(chunk.data()), static_cast<uInt>(chunk.size()));
  chunk = number(chunk.size() - 4) + chunk + number(crc);
  std::string png = makePng(1, 1, 8, PNG_COLOR_TYPE_RGB, {1, 2, 3});
  for (int i = 0; i < 100; ++i) png.insert(33, chunk);  // behind the header
  const long before_kB = peak_kB();
  CHECK(complaint(png) == "none");
  CHECK(peak_kB() - before_kB < 400'000);
}

TEST_CASE("PNG: a chunk of few bytes that claims two gigabytes takes no memory") {
  std::string png = makePng(1, 1, 8, PNG_COLOR_TYPE_RGB, {1, 2, 3});
  png.insert(33, "\x79\x70\x01\x12zTXtkey");  // behind the header: length and type
  const long before_kB = peak_kB();
  CHECK_THAT(complaint(png), Contains("is a broken PNG"));
  CHECK(peak_kB() - before_kB < 400'000);
}

TEST_CASE("JPEG: colour, grey, progressive") {
  const bool progressive = GENERATE(false, true);
  Bytes samples;
  for (int i = 0; i < 32 * 16; ++i) samples.insert(samples.end(), {200, 100, 50});
  const Image image = decodeImage(makeJpeg(32, 16, 3, samples, 0, progressive), "x");
  CHECK(image.width == 32);
  CHECK(image.height == 16);
  const Bytes p = pixel(image, 9, 9);
  CHECK(std::abs(p[0] - 200) <= 2);
  CHECK(std::abs(p[1] - 100) <= 2);
  CHECK(std::abs(p[2] - 50) <= 2);
  CHECK(p[3] == 255);
  CHECK(pixel(decodeImage(makeJpeg(8, 8, 1, Bytes(64, 77), 0, progressive), "x"), 3, 3) ==
        Bytes{77, 77, 77, 255});
}

TEST_CASE("JPEG: every EXIF orientation shows the picture upright") {
  // A 16×8 picture, upright, is dark in the 4×4 px at its top left corner.
  const int orientation = GENERATE(1, 2, 3, 4, 5, 6, 7, 8);
  const int w = 16, h = 8;
  const bool transposed = orientation >= 5;
  const int stored_w = transposed ? h : w, stored_h = transposed ? w : h;
  // Stored row 0 / column 0 are these sides of the upright picture (EXIF 2.3, table 6).
  const bool row_bottom = orientation == 3 || orientation == 4,
             column_right = orientation == 2 || orientation == 3;
  const bool row_right = orientation == 6 || orientation == 7,
             column_bottom = orientation == 7 || orientation == 8;
  Bytes samples(static_cast<size_t>(w * h), 255);
  for (int sy = 0; sy < stored_h; ++sy) {
    for (int sx = 0; sx < stored_w; ++sx) {
      int x = column_right ? w - 1 - sx : sx, y = row_bottom ? h - 1 - sy : sy;
      if (transposed) {
        x = row_right ? w - 1 - sy : sy;
        y = column_bottom ? h - 1 - sx : sx;
      }
      if (x < 4 && y < 4) samples[static_cast<size_t>(sy * stored_w + sx)] = 0;
    }
  }
  const Image image = decodeImage(makeJpeg(stored_w, stored_h, 1, samples, orientation), "x");
  REQUIRE(image.width == w);
  REQUIRE(image.height == h);
  CHECK(pixel(image, 1, 1)[0] < 60);
  CHECK(pixel(image, 14, 1)[0] > 200);
  CHECK(pixel(image, 1, 6)[0] > 200);
  CHECK(pixel(image, 14, 6)[0] > 200);
}

// The last scan of a JPEG, so many times more.
std::string withMoreScans(const std::string& jpeg, int more) {
  const std::string scan = jpeg.substr(jpeg.rfind("\xff\xda"), jpeg.size() - 2 - jpeg.rfind("\xff\xda"));
  std::string bytes = jpeg.substr(0, jpeg.size() - 2);
  for (int i = 0; i < more; ++i) bytes += scan;
  return bytes + jpeg.substr(jpeg.size() - 2);
}

TEST_CASE("JPEG: hundreds of passes over a picture are refused, the more px it has the fewer") {
  const std::string small = makeJpeg(8, 8, 1, Bytes(64, 9), 0, true);
  CHECK(decodeImage(withMoreScans(small, 90), "x").width == 8);
  CHECK_THAT(complaint(withMoreScans(small, 100), "x.jpg"),
             Contains("x.jpg: is a broken JPEG (more than 100 scans)"));
  const std::string large = makeJpeg(8000, 8000, 1, Bytes(64'000'000, 9), 0, true);
  CHECK_THAT(complaint(withMoreScans(large, 90), "x.jpg"), Contains("more than 25 scans"));
}

TEST_CASE("JPEG: CMYK and truncated files are refused with what to do") {
  CHECK_THAT(complaint(makeJpeg(8, 8, 4, Bytes(256, 9)), "a.jpg"),
             Contains("a.jpg: is a CMYK JPEG") && Contains("magick"));
  Rng rng(1);
  Bytes noise(64 * 64);
  for (auto& sample : noise) sample = static_cast<std::uint8_t>(rng.below(256));
  const bool progressive = GENERATE(false, true);
  const std::string whole = makeJpeg(64, 64, 1, noise, 0, progressive);
  for (size_t size = 3; size + 2 < whole.size(); size += 97) {
    CHECK_THAT(complaint(whole.substr(0, size), "cut.jpg"), Contains("cut.jpg: is a broken JPEG"));
  }
}

TEST_CASE("what is no picture is refused by its name") {
  const TempDir dir;
  CHECK_THAT(complaint("", "none.png"), Contains("none.png: is empty"));
  CHECK_THAT(complaint("hello", "text.png"), Contains("text.png: is not a picture that can be read"));
  CHECK_THAT(complaint(std::string("\0\0\0\x18"
                                   "ftypheic\0\0\0\0",
                                   16),
                       "photo.heic"),
             Contains("photo.heic: is a HEIC picture; convert it by `heif-convert photo.heic photo.png`"));
  CHECK_THAT(complaint(std::string("\0\0\0\x18"
                                   "ftypavif\0\0\0\0",
                                   16)),
             Contains("AVIF"));
  CHECK_THAT(complaint("RIFFWEBP"), Contains("is not a picture that can be read"));
  CHECK_THROWS_WITH(readImage(dir.file("gone.png")), Contains("gone.png: cannot be read"));
}

TEST_CASE("the first bytes decide, not the name") {
  const TempDir dir;
  writeFile(dir.file("really_a_jpeg.png"), makeJpeg(8, 8, 1, Bytes(64, 77)));
  CHECK(readImage(dir.file("really_a_jpeg.png")).width == 8);
}

namespace {

std::string little(std::uint32_t value, int size) {
  std::string bytes;
  for (int i = 0; i < size; ++i) bytes += i < 4 ? static_cast<char>(value >> 8 * i) : 0;
  return bytes;
}

// 2×1 px: red, green.
std::string makeBmp() {
  return "BM" + little(62, 4) + little(0, 4) + little(54, 4) + little(40, 4) + little(2, 4) + little(1, 4) +
         little(1, 2) + little(24, 2) + little(0, 4) + little(8, 4) + little(0, 16) +
         std::string("\0\0\xff\0\xff\0\0\0", 8);
}

std::string makeTiff(std::uint32_t bits = 8) {
  const auto entry = [](int tag, int type, std::uint32_t value) {
    return little(static_cast<std::uint32_t>(tag), 2) + little(static_cast<std::uint32_t>(type), 2) +
           little(1, 4) + little(value, 4);
  };
  const std::uint32_t bits_at = 8 + 2 + 9 * 12 + 4;
  return "II*" + std::string(1, '\0') + little(8, 4) + little(9, 2) + entry(256, 3, 2) + entry(257, 3, 1) +
         little(258, 2) + little(3, 2) + little(3, 4) + little(bits_at, 4) + entry(259, 3, 1) +
         entry(262, 3, 2) + entry(273, 4, bits_at + 6) + entry(277, 3, 3) + entry(278, 3, 1) +
         entry(279, 4, 6) + little(0, 4) + little(bits, 2) + little(bits, 2) + little(bits, 2) +
         std::string("\xff\0\0\0\xff\0", 6);
}

// 2×1 px: red and green by a palette; `transparent` is the index of the transparent colour or -1.
std::string makeGif(int transparent) {
  std::string bytes = "GIF89a" + little(2, 2) + little(1, 2) + "\x80" + std::string(2, '\0') +
                      std::string("\xff\0\0\0\xff\0", 6);
  if (transparent >= 0) {
    bytes += std::string("\x21\xf9\x04\x01\0\0", 6) + static_cast<char>(transparent) + std::string(1, '\0');
  }
  // Codes of 3 bits, lowest first: clear (4), 0, 1, end (5).
  const int codes = 4 | 0 << 3 | 1 << 6 | 5 << 9;
  return bytes + "," + little(0, 4) + little(2, 2) + little(1, 2) + std::string(1, '\0') + "\x02\x02" +
         little(static_cast<std::uint32_t>(codes), 2) + std::string("\0;", 2);
}

const std::string kWebp("RIFF\x1a\0\0\0WEBPVP8L\x0d\0\0\0\x2f\0\0\0\x10\x07\x10\x11\x11\x88\x88\xfe\x07\0",
                        34);

}  // namespace

#ifdef SKEL_IMGCODECS
TEST_CASE("BMP, TIFF, GIF and WebP come through the plugin") {
  for (const std::string& bytes : {makeBmp(), makeTiff(), makeGif(-1)}) {
    const Image image = decodeImage(bytes, "x");
    REQUIRE(image.width == 2);
    REQUIRE(image.height == 1);
    CHECK(pixel(image, 0, 0) == Bytes{255, 0, 0, 255});
    CHECK(pixel(image, 1, 0) == Bytes{0, 255, 0, 255});
  }
  CHECK(pixel(decodeImage(makeGif(1), "x"), 1, 0)[3] == 0);
  const Image webp = decodeImage(kWebp, "x");
  CHECK(webp.width == 1);
  CHECK(webp.height == 1);
}

// One frame of kWebp's picture at (2, 0) of a canvas of 3x2 px, behind a chunk that says nothing.
std::string animatedWebp() {
  const std::string pixels = kWebp.substr(12) + std::string(kWebp.size() % 2, '\0');
  const std::string frame = little(1, 3) + little(0, 3) + little(0, 3) + little(0, 3) + little(100, 3) +
                            std::string(1, '\0') + pixels;
  const std::string content = "WEBPVP8X" + little(10, 4) + std::string("\x02\0\0\0", 4) + little(2, 3) +
                              little(1, 3) + "ANIM" + little(6, 4) + std::string(6, '\0') + "ANMF" +
                              little(static_cast<std::uint32_t>(frame.size()), 4) + frame;
  return "RIFF" + little(static_cast<std::uint32_t>(content.size()), 4) + content;
}

TEST_CASE("an animated WebP as a drawing gives its first frame, on its canvas") {
  const std::string bytes = animatedWebp();
  const Image image = decodeImage(bytes, "x"), still = decodeImage(kWebp, "x");
  REQUIRE(image.width == 3);
  REQUIRE(image.height == 2);
  CHECK(pixel(image, 2, 0) == pixel(still, 0, 0));
  CHECK(pixel(image, 0, 0) == Bytes{0, 0, 0, 0});
  CHECK(pixel(image, 2, 1) == Bytes{0, 0, 0, 0});
  for (size_t size = 16; size + 3 < bytes.size(); ++size)
    CHECK_THAT(complaint(bytes.substr(0, size), "cut"), Contains("cut: ") || Contains("none"));
  std::string outside = bytes;
  outside[bytes.find("ANMF") + 8] = 2;
  CHECK_THAT(complaint(outside, "x"),
             Contains("x: is a broken picture (its first frame lies outside of it)"));
}

TEST_CASE("a TIFF of more than 16 bits a channel is refused before its pixels are in memory") {
  CHECK_THAT(complaint(makeTiff(32), "x"), Contains("x: has pixels of more than 16 bits a channel"));
}

TEST_CASE("broken BMP, TIFF, GIF and WebP are refused") {
  for (const std::string& whole : {makeBmp(), makeTiff(), makeGif(0), kWebp}) {
    for (size_t size = 14; size + 3 < whole.size(); ++size) {
      // A file that is cut where only padding is missing may still be read.
      CHECK_THAT(complaint(whole.substr(0, size), "cut"), Contains("cut: ") || Contains("none"));
    }
    CHECK_THAT(complaint(whole.substr(0, 26), "cut"), Contains("cut: is"));
  }
}
#else
TEST_CASE("without the plugin a WebP file is refused as not readable here") {
  CHECK_THROWS_AS(decodeImage(kWebp, "x"), UnavailableError);
}
#endif
