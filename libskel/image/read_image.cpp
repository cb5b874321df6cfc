#include "libskel/image/read_image.h"

#include "libskel/core/error.h"
#include "libskel/core/files.h"
#include "libskel/core/foreign_files.h"
#include "libskel/image/formats.h"

namespace skel {

Image decodeImage(std::string_view bytes, const std::string& file) {
  if (bytes.empty()) throw InputError(file, "is empty");
  const Format format = formatOf(bytes);
  switch (format) {
    case Format::kPng:
      return decodePng(bytes, file);
    case Format::kJpeg:
      return decodeJpeg(bytes, file);
    case Format::kWebp:
    case Format::kBmp:
    case Format::kTiff:
    case Format::kGif:
      return decodeByPlugin(bytes, format, file);
    case Format::kHeic:
      throw InputError(file, howToConvert(file, ".heic"));
    case Format::kAvif:
      throw InputError(file, howToConvert(file, ".avif"));
    case Format::kUnknown:
      break;
  }
  if (const std::string remedy = howToConvert(file); !remedy.empty()) throw InputError(file, remedy);
  throw InputError(file, "is not a picture that can be read (PNG, JPEG, WebP, BMP, TIFF or GIF)");
}

Image readImage(const std::string& path) { return decodeImage(readFile(path), path); }

Plane8 readMask(const std::string& path) { return decodeMask(readFile(path), path); }

Plane8 decodeMask(std::string_view bytes, const std::string& file) {
  const Image image = decodeImage(bytes, file);
  Plane8 mask(image.height, image.width);
  for (Eigen::Index i = 0; i < mask.size(); ++i) {
    const auto p = image.rgba.row(i);
    const int luma = (299 * p[0] + 587 * p[1] + 114 * p[2] + 500) / 1000;
    mask.data()[i] = luma >= 128 && p[3] >= 128 ? 255 : 0;
  }
  return mask;
}

}  // namespace skel
