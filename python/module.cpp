// skel._core: the library for Python. python/skel/__init__.py gives its names away, _core.pyi their types.
#include <algorithm>
#include <cstdio>

#include "libskel/image/read_image.h"
#include "python/bindings.h"

namespace skel::python {

py::array_t<std::uint8_t> arrayOf(const Image& image) {
  py::array_t<std::uint8_t> array({image.height, image.width, 4});
  std::copy_n(image.rgba.data(), image.rgba.size(), array.mutable_data());
  return array;
}

std::string pathOf(const py::object& path, const std::string& name, const std::string& wanted) {
  if (!py::isinstance<py::str>(path) && !py::hasattr(path, "__fspath__"))
    throw UsageError(name + ": must be " + wanted);
  PyObject* bytes = nullptr;
  if (PyUnicode_FSConverter(path.ptr(), &bytes) == 0) {
    const py::error_already_set error;
    if (!error.matches(PyExc_ValueError)) throw error;
    throw UsageError(name + ": holds a character that no file's name can have");
  }
  return py::reinterpret_steal<py::bytes>(bytes);
}

namespace {

std::string shapeText(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) text += (i ? ", " : "") + std::to_string(array.shape(i));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

Bytes pixelsOf(const py::array& array, const std::string& name, bool good, const std::string& wanted) {
  if (!good || array.size() == 0 || std::max(array.shape(0), array.shape(1)) > kLongestSide_px ||
      array.shape(0) * array.shape(1) > kMaxPixels)
    throw UsageError(name + ": has shape " + shapeText(array) + ", must be " + wanted +
                     ", neither side 0 or above " + std::to_string(kLongestSide_px) + ", at most " +
                     std::to_string(kMaxPixels) + " pixels");
  return Bytes(array);
}

// Nothing but numbers, else UsageError.
py::array arrayIn(const py::object& numbers, const std::string& name) {
  const py::array array = py::array::ensure(numbers);
  if (!array) throw UsageError(name + ": must be numbers");
  if (array.size() > 0 && std::string("biuf").find(array.dtype().kind()) == std::string::npos)
    throw UsageError(name + ": must be numbers");
  return array;
}

}  // namespace

Rows rowsIn(const py::object& numbers, int columns, const std::string& name) {
  const py::array array = arrayIn(numbers, name);
  if (array.ndim() != 2 || array.shape(1) != columns)
    throw UsageError(name + ": has shape " + shapeText(array) + ", must be (N, " + std::to_string(columns) +
                     ")");
  return array.cast<Rows>();
}

std::vector<double> numbersIn(const py::object& numbers, int count, const std::string& name) {
  const py::array array = arrayIn(numbers, name);
  if (array.ndim() != 1 || (count >= 0 && array.shape(0) != count))
    throw UsageError(name + ": has shape " + shapeText(array) + ", must be (" +
                     (count < 0 ? "N" : std::to_string(count)) + ",)");
  return array.cast<std::vector<double>>();
}

std::map<std::string, py::object> namedIn(const py::object& mapping, const std::string& name) {
  if (!py::hasattr(mapping, "keys")) throw UsageError(name + ": must be a dict");
  std::map<std::string, py::object> named;
  for (const auto& [key, value] : py::dict(mapping)) {
    if (!py::isinstance<py::str>(key)) throw UsageError(name + ": must have names as keys");
    named[key.cast<std::string>()] = py::reinterpret_borrow<py::object>(value);
  }
  return named;
}

void checkRange(const std::string& name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  char range[80];
  std::snprintf(range, sizeof range, "%.10g to %.10g", low, high);
  throw UsageError(name + ": must be from " + range);
}

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
  if (!py::isinstance<py::array_t<bool>>(array) && !py::isinstance<py::array_t<std::uint8_t>>(array))
    throw UsageError(name + ": must be of type bool or uint8, not 0 on the figure");
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
  // Now: where several threads are the first to need numpy, one that looks it up without the interpreter's
  // lock and one that waits for it with the lock wait for each other.
  py::array();
  bindErrors(module);
  bindCharacters(module);
  bindLearning(module);
  bindDrawings(module);
}
