#include "libskel/core/in_order.h"

#include <condition_variable>
#include <mutex>
#include <vector>

#include "libskel/core/parallel.h"

namespace skel {
namespace {

// So far those that wait for a slow piece may be ahead of it, for each thread.
constexpr std::size_t kSlotsPerThread = 16;

class Line {
 public:
  Line(std::size_t slots, const StepsInOrder& steps) : done_(slots, 0), steps_(steps) {}

  // What one thread does: first hand on what is ready, then begin another piece.
  void run() {
    std::unique_lock lock(mutex_);
    while (!failed_) {
      if (const std::size_t slot = taken_ % done_.size(); !taking_ && done_[slot]) {
        taking_ = true;
        outside(lock, [&] { steps_.take(slot); });
        done_[slot] = 0;
        ++taken_;
        taking_ = false;
        changed_.notify_all();
      } else if (!reading_ && !ended_ && begun_ - taken_ < done_.size()) {
        begin(lock);
      } else if (ended_) {
        return;  // whoever works on the last pieces takes them
      } else {
        changed_.wait(lock);
      }
    }
  }

 private:
  void begin(std::unique_lock<std::mutex>& lock) {
    const std::size_t slot = begun_ % done_.size();
    reading_ = true;
    bool more = false;
    outside(lock, [&] { more = steps_.next(slot); });
    reading_ = false;
    changed_.notify_all();
    ended_ = !more;
    if (!more) return;
    ++begun_;
    outside(lock, [&] { steps_.work(slot); });
    done_[slot] = 1;
  }

  template <class Step>
  void outside(std::unique_lock<std::mutex>& lock, const Step& step) {
    lock.unlock();
    try {
      step();
    } catch (...) {
      lock.lock();
      failed_ = true;
      changed_.notify_all();
      throw;
    }
    lock.lock();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t begun_ = 0, taken_ = 0;
  bool reading_ = false, taking_ = false, ended_ = false, failed_ = false;
  std::vector<char> done_;  // by slot: worked on, not yet taken
  const StepsInOrder& steps_;
};

}  // namespace

std::size_t slotsInOrder(int threads) { return kSlotsPerThread * threadCount(threads); }

void parallelInOrder(int threads, const StepsInOrder& steps) {
  Line line(slotsInOrder(threads), steps);
  const std::size_t count = threadCount(threads);
  parallelFor(count, int(count), [&](std::size_t) { line.run(); });
}

}  // namespace skel
