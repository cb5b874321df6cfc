#include "libskel/core/progress.h"
#include "libskel/core/text.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace skel {
using namespace std::chrono;

ProgressBar::ProgressBar(std::string title, std::size_t total)
    : title_(std::move(title)),
      total_(std::max<std::size_t>(total, 1)),
      visible_(::isatty(STDERR_FILENO) != 0),
      start_(steady_clock::now()),
      last_(start_) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::advance(std::size_t steps, const std::string& note) {
  const std::lock_guard lock(mutex_);
  done_ += steps;
  note_ = note;
  const auto now = steady_clock::now();
  if (!visible_ || (now - last_ < milliseconds(100) && done_ < total_)) return;
  last_ = now;
  draw();
}

void ProgressBar::clear() {
  if (drawn_) std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

void ProgressBar::draw() {
  constexpr std::size_t kWidth = 30;
  const double share = std::min(1.0, static_cast<double>(done_) / static_cast<double>(total_));
  const auto filled = static_cast<std::size_t>(share * kWidth);
  const double elapsed_s = duration<double>(last_ - start_).count();
  const int left_s = share > 0 ? static_cast<int>(elapsed_s * (1 - share) / share + 0.5) : 0;
  std::fprintf(stderr, "\r\033[K%s [%s%s] %zu/%zu %d:%02d left  %s", title_.c_str(),
               std::string(filled, '=').c_str(), std::string(kWidth - filled, ' ').c_str(), done_, total_,
               left_s / 60, left_s % 60, printable(note_).c_str());
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace skel
