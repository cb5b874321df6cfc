#include "libskel/core/error.h"

#include "python/bindings.h"

namespace skel::python {

void bindErrors(py::module_& module) {
  const auto error = py::register_exception<Error>(module, "Error", PyExc_Exception);
  py::register_exception<UsageError>(module, "UsageError",
                                     py::make_tuple(error, py::handle(PyExc_ValueError)));
  py::register_exception<InputError>(module, "InputError",
                                     py::make_tuple(error, py::handle(PyExc_ValueError)));
  py::register_exception<UnavailableError>(module, "UnavailableError", error);
  py::register_exception<OutputError>(module, "OutputError",
                                      py::make_tuple(error, py::handle(PyExc_OSError)));
  const auto about = [&](const char* name, const char* text) {
    module.attr(name).attr("__module__") = "skel";
    module.attr(name).attr("__doc__") = text;
  };
  about("Error",
        "What can go wrong. Its text is one sentence: which file, where in it, what is wrong, what to do.");
  about("UsageError", "What was asked for makes no sense.");
  about("InputError", "A file or an array that cannot be used, or a picture without a figure.");
  about("UnavailableError", "Something that this machine lacks: memory, a plugin.");
  about("OutputError", "A file that could not be written.");
}

}  // namespace skel::python
