// The parts of the module, and how numbers and errors cross over. Arrays are copied, both ways.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>

#include "libskel/core/caught_error.h"
#include "libskel/image/image.h"

namespace skel::python {
namespace py = pybind11;

void bindErrors(py::module_& module);
void bindCharacters(py::module_& module);
void bindDrawings(py::module_& module);
void bindLearning(py::module_& module);

using Path = std::filesystem::path;  // from str or os.PathLike
using Bytes = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>;

// A str or an os.PathLike. Throws UsageError, which calls it `name`.
std::string pathOf(const py::object& path, const std::string& name);
// H×W×4 and back; also from H×W×3 and H×W. Throws UsageError, which calls the array `name`.
py::array_t<std::uint8_t> arrayOf(const Image& image);
Image imageOf(const py::array& array, const std::string& name);
// H×W; of any numbers: 255 where they are not 0.
Plane8 maskOf(const py::array& array, const std::string& name);

// Without the interpreter's lock; whatever is thrown leaves as an Error of ours, which names `source` unless
// it names something itself.
template <class Work>
auto unlocked(const std::string& source, const Work& work) {
  const py::gil_scoped_release release;
  return throwingErrors(source, work);
}

}  // namespace skel::python
