#include "python/interruptible.h"

#include <atomic>
#include <chrono>
#include <future>
#include <optional>

namespace skel::python {
namespace {
struct Interrupted {};
}  // namespace

void interruptible(std::size_t steps, const py::object& progress,
                   const std::function<void(const Tick& tick, const Pause& pause)>& work) {
  std::atomic<std::size_t> done = 0;
  std::atomic<double> last_loss = 0;
  std::atomic<bool> stop = false;
  std::future<void> working = std::async(std::launch::async, [&] {
    const auto pause = [&] {
      if (stop) throw Interrupted();
    };
    const auto tick = [&](double loss) {
      pause();
      last_loss = loss;
      ++done;
    };
    work(tick, pause);
  });
  std::optional<py::error_already_set> raised;
  std::size_t told = 0;
  const auto ready = [&] {
    const py::gil_scoped_release release;
    return working.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready;
  };
  const auto tell = [&] {
    const std::size_t now = done;
    if (progress.is_none() || now == told) return;
    told = now;
    progress(now, steps, last_loss.load());
  };
  while (!ready()) {
    if (stop) continue;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      tell();
    } catch (py::error_already_set& error) {
      raised.emplace(std::move(error));
      stop = true;
    }
  }
  try {
    working.get();
    if (!raised) tell();
  } catch (const Interrupted&) {
  } catch (const py::error_already_set&) {
    throw;
  } catch (const Error&) {
    if (!raised) throw;
  } catch (...) {
    if (!raised) throw caughtError("the training");
  }
  if (raised) throw std::move(*raised);
}

}  // namespace skel::python
