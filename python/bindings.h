// The parts of the module, and how numbers and errors cross over. Arrays are copied, both ways.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "libskel/core/caught_error.h"
#include "libskel/image/image.h"
#include "libskel/import/read_character.h"

namespace skel::python {
namespace py = pybind11;

void bindErrors(py::module_& module);
void bindCharacters(py::module_& module);
void bindDrawings(py::module_& module);
void bindLearning(py::module_& module);

using Bytes = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>;

// What Python calls a Character. All but the clips stays as it is from the start.
struct Character {
  ExportOptions exported() const { return {.name = name, .bones = bones, .ink_hull = ink_hull}; }

  RiggedCharacter character;
  // Others than these take their place, they never change: who lets go of the interpreter's lock holds them.
  std::shared_ptr<const std::vector<Clip>> clips;
  std::string name;
  BoneStyle bones = BoneStyle::kAlong;
  bool ink_hull = false;
  bool drawn = false;                // else nobody knows where its joints lie in a drawing
  std::vector<std::string> sources;  // files that it was made from, absolute: never written over
};

// A str or an os.PathLike. Throws UsageError, which calls it `name` and says that it must be `wanted`.
std::string pathOf(const py::object& path, const std::string& name,
                   const std::string& wanted = "the path of a file");
// Numbers of whatever numpy makes an array of: rows of so many, or as many as there are (`count` -1). Throws
// UsageError, which calls them `name`.
using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
Rows rowsIn(const py::object& numbers, int columns, const std::string& name);
std::vector<double> numbersIn(const py::object& numbers, int count, const std::string& name);
// The pairs of a dict or another mapping with names as keys. Throws UsageError, which calls it `name`.
std::map<std::string, py::object> namedIn(const py::object& mapping, const std::string& name);
// "17 joints, 1234 vertices".
std::string sizesOf(const RiggedCharacter& character);
// Throws UsageError, which calls it `name`.
void checkRange(const std::string& name, double value, double low, double high);
// H×W×4 and back; also from H×W×3 and H×W. Throws UsageError, which calls the array `name`.
py::array_t<std::uint8_t> arrayOf(const Image& image);
Image imageOf(const py::array& array, const std::string& name);
// H×W of bool or uint8: 255 where they are not 0. Throws the same.
Plane8 maskOf(const py::array& array, const std::string& name);

// Without the interpreter's lock; whatever is thrown leaves as an Error of ours, which names `source` unless
// it names something itself.
template <class Work>
auto unlocked(const std::string& source, const Work& work) {
  const py::gil_scoped_release release;
  return throwingErrors(source, work);
}

}  // namespace skel::python
