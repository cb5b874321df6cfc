#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "libskel/core/error.h"
#include "libskel/image/formats.h"
#include "libskel/image/plugin/codec.h"

namespace skel {
namespace {
namespace fs = std::filesystem;

// Programs lie in bin, plugins in lib/skel beside it, in the build folder and when installed.
fs::path pluginPath() {
  std::error_code failure;
  const fs::path program = fs::read_symlink("/proc/self/exe", failure);
  return program.parent_path().parent_path() / "lib" / "skel" / "skel_imgcodecs.so";
}

SkelDecode loadDecoder() {
  void* library = dlopen(pluginPath().c_str(), RTLD_NOW | RTLD_LOCAL);
  return library ? reinterpret_cast<SkelDecode>(dlsym(library, SKEL_DECODE_NAME)) : nullptr;
}

}  // namespace

Image decodeByPlugin(std::string_view bytes, Format format, const std::string& file) {
  const HeaderSize size = headerSize(bytes, format);
  checkSize(size.width, size.height, file);
  if (format == Format::kTiff && tiffBitsPerSample(bytes) > 16)
    throw InputError(file, "has pixels of more than 16 bits a channel; export it with 8 or 16");

  // OpenCV reads still ones alone.
  if (const auto frame = format == Format::kWebp ? firstWebpFrame(bytes) : std::nullopt) {
    const Image part = decodeByPlugin(frame->bytes, format, file);
    if (frame->x + part.width > size.width || frame->y + part.height > size.height)
      throw InputError(file, "is a broken picture (its first frame lies outside of it); export it again");
    Image canvas(static_cast<int>(size.width), static_cast<int>(size.height));
    canvas.rgba.setZero();
    for (int y = 0; y < part.height; ++y)
      std::copy_n(part.pixel(0, y), 4 * part.width, canvas.pixel(frame->x, frame->y + y));
    return oriented(std::move(canvas), webpOrientation(bytes));
  }

  static const SkelDecode decode = loadDecoder();
  if (decode == nullptr) {
    throw UnavailableError(file + ": only PNG and JPEG can be read here, for the plugin " +
                           pluginPath().string() + " is missing; convert the picture to PNG");
  }
  int width = 0, height = 0;
  std::uint8_t* pixels = nullptr;
  char message[160] = "";
  const int done = decode(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), &width, &height,
                          &pixels, message, sizeof message);
  const std::unique_ptr<std::uint8_t, decltype(&std::free)> owner(pixels, &std::free);
  if (!done) throw InputError(file, "is a broken picture (" + std::string(message) + "); export it again");
  checkSize(width, height, file);
  Image image(width, height);
  std::copy_n(pixels, image.rgba.size(), image.rgba.data());
  return oriented(std::move(image), format == Format::kWebp ? webpOrientation(bytes) : 1);
}

}  // namespace skel
