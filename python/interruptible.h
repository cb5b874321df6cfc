// Work that lasts, which Ctrl+C ends.
#pragma once

#include <functional>

#include "python/bindings.h"

namespace skel::python {

using Tick = std::function<void(double loss)>;
using Pause = std::function<void()>;

// Calls work(tick, pause) on a thread of its own, without the interpreter's lock. Both may be called by any
// thread, and throw once Ctrl+C has been pressed, so that the work ends; `tick` says that a step is done,
// `pause` that there are none yet. Meanwhile `progress`, a callable or None, is called with (steps done,
// steps in all, the last loss). What it throws, or KeyboardInterrupt, is thrown here after the work has
// ended.
void interruptible(std::size_t steps, const py::object& progress,
                   const std::function<void(const Tick& tick, const Pause& pause)>& work);

}  // namespace skel::python
