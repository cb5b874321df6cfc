#include "libskel/core/progress.h"
#include "libskel/core/text.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace skel {
using namespace std::chrono;

namespace {

// "4:07"
std::string clockTime(double time_s) {
  const int whole_s = static_cast<int>(time_s + 0.5);
  char text[32];
  std::snprintf(text, sizeof text, "%d:%02d", whole_s / 60, whole_s % 60);
  return text;
}

double left_s(std::size_t done, std::size_t total, double elapsed_s) {
  return done > 0 && done < total ? elapsed_s * static_cast<double>(total - done) / static_cast<double>(done)
                                  : 0;
}

}  // namespace

ProgressBar::ProgressBar(std::string title, std::size_t total, bool shown)
    : title_(std::move(title)),
      total_(total),
      shown_(shown),
      terminal_(::isatty(STDERR_FILENO) != 0),
      start_(steady_clock::now()),
      last_(start_) {}

ProgressBar::~ProgressBar() { clear(); }

double ProgressBar::elapsed_s() const { return duration<double>(last_ - start_).count(); }

void ProgressBar::advance(std::size_t steps, const std::string& note) {
  const std::lock_guard lock(mutex_);
  done_ += steps;
  note_ = note;
  if (!shown_) return;
  const auto now = steady_clock::now();
  if (terminal_) {
    if (now - last_ < milliseconds(100) && done_ != total_) return;
    last_ = now;
    draw();
  } else if (done_ != total_ && now - last_ >= duration<double>(pauseBetweenLines_s(elapsed_s()))) {
    last_ = now;
    std::fprintf(stderr, "%s\n", progressLine(title_, done_, total_, elapsed_s(), printable(note_)).c_str());
  }
}

void ProgressBar::expect(std::size_t more) {
  const std::lock_guard lock(mutex_);
  if (total_ > 0) total_ += more;
}

void ProgressBar::clear() {
  const std::lock_guard lock(mutex_);
  if (drawn_) std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

void ProgressBar::draw() {
  constexpr std::size_t kWidth = 30;
  const auto filled = total_ == 0 ? 0 : kWidth * std::min(done_, total_) / total_;
  if (total_ == 0)
    std::fprintf(stderr, "\r\033[K%s", progressLine(title_, done_, 0, elapsed_s(), printable(note_)).c_str());
  else
    std::fprintf(stderr, "\r\033[K%s [%s%s] %zu/%zu %s left  %s", title_.c_str(),
                 std::string(filled, '=').c_str(), std::string(kWidth - filled, ' ').c_str(), done_, total_,
                 clockTime(left_s(done_, total_, elapsed_s())).c_str(), printable(note_).c_str());
  std::fflush(stderr);
  drawn_ = true;
}

std::string progressLine(const std::string& title, std::size_t done, std::size_t total, double elapsed_s,
                         const std::string& note) {
  const std::string line = title + ": " + std::to_string(done);
  std::string time = " in " + clockTime(elapsed_s);
  if (total > 0) {
    time = " of " + std::to_string(total);
    // What comes before the first step may have taken longer than all steps will.
    if (done > 1 || total == 1) time += ", " + clockTime(left_s(done, total, elapsed_s)) + " left";
  }
  return line + time + (note.empty() ? "" : ", " + note);
}

double pauseBetweenLines_s(double elapsed_s) { return std::clamp(elapsed_s / 10, 5.0, 60.0); }

}  // namespace skel
