// Work that lasts, which Ctrl+C ends.
#pragma once

#include <functional>

#include "python/bindings.h"

namespace skel::python {

// Calls work(tick) on a thread of its own, without the interpreter's lock. `tick`, which any thread may call,
// says that a step is done, and throws once Ctrl+C has been pressed, so that the work ends. Meanwhile
// `progress`, a callable or None, is called with (steps done, steps in all, the last loss). What it throws,
// or KeyboardInterrupt, is thrown here after the work has ended.
void interruptible(std::size_t steps, const py::object& progress,
                   const std::function<void(const std::function<void(double loss)>& tick)>& work);

}  // namespace skel::python
