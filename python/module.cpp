// skel._core: the library for Python. python/skel/__init__.py gives its names away, _core.pyi their types.
#include <algorithm>

#include "libskel/image/read_image.h"
#include "python/bindings.h"

namespace skel::python {

py::array_t<std::uint8_t> arrayOf(const Image& image) {
  py::array_t<std::uint8_t> array({image.height, image.width, 4});
  std::copy_n(image.rgba.data(), image.rgba.size(), array.mutable_data());
  return array;
}

std::string pathOf(const py::object& path, const std::string& name) {
  if (!py::isinstance<py::str>(path) && !py::hasattr(path, "__fspath__"))
    throw UsageError(name + ": must be the path of a file, or an array");
  return path.cast<Path>().string();
}

namespace {

std::string shapeText(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) text += (i ? ", " : "") + std::to_string(array.shape(i));
  return text + ")";
}

Bytes pixelsOf(const py::array& array, const std::string& name, bool good, const std::string& wanted) {
  if (!good || array.size() == 0 || std::max(array.shape(0), array.shape(1)) > kLongestSide_px ||
      array.shape(0) * array.shape(1) > kMaxPixels)
    throw UsageError(name + ": has shape " + shapeText(array) + ", must be " + wanted +
                     ", neither side 0 or above " + std::to_string(kLongestSide_px) + ", at most " +
                     std::to_string(kMaxPixels) + " pixels");
  return Bytes(array);
}

}  // namespace

Image imageOf(const py::array& array, const std::string& name) {
  if (!py::isinstance<py::array_t<std::uint8_t>>(array))
    throw UsageError(name + ": must be of type uint8, 0 to 255 a channel");
  const bool grey = array.ndim() == 2;
  const bool good = grey || (array.ndim() == 3 && (array.shape(2) == 3 || array.shape(2) == 4));
  const Bytes pixels =
      pixelsOf(array, name, good, "(height, width), (height, width, 3) or (height, width, 4)");
  const int channels = grey ? 1 : static_cast<int>(array.shape(2));
  Image image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
  const std::uint8_t* from = pixels.data();
  for (Eigen::Index i = 0; i < image.rgba.rows(); ++i, from += channels)
    for (int c = 0; c < 4; ++c)
      image.rgba(i, c) = c == 3 && channels < 4 ? std::uint8_t{255} : from[std::min(c, channels - 1)];
  return image;
}

Plane8 maskOf(const py::array& array, const std::string& name) {
  const Bytes pixels =
      pixelsOf(array.attr("astype")("bool").cast<py::array>(), name, array.ndim() == 2, "(height, width)");
  Plane8 mask(array.shape(0), array.shape(1));
  for (Eigen::Index i = 0; i < mask.size(); ++i) mask.data()[i] = pixels.data()[i] ? 255 : 0;
  return mask;
}

}  // namespace skel::python

PYBIND11_MODULE(_core, module) {
  using namespace skel::python;
  module.doc() = "The library of skel, bound to Python.";
  module.attr("__version__") = SKEL_VERSION;
  bindErrors(module);
  bindCharacters(module);
  bindLearning(module);
  bindDrawings(module);
}
