// A progress bar on stderr, for whatever takes longer than a second.
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace skel {

// Draws only if stderr is a terminal. May be called from several threads.
class ProgressBar {
 public:
  ProgressBar(std::string title, std::size_t total);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // `note` stands behind the bar, e.g. the loss.
  void advance(std::size_t steps = 1, const std::string& note = {});
  // Takes the bar away so that a message can be printed; the next advance() draws it again.
  void clear();

 private:
  void draw();

  std::string title_, note_;
  std::size_t total_, done_ = 0;
  bool visible_, drawn_ = false;
  std::chrono::steady_clock::time_point start_, last_;
  std::mutex mutex_;
};

}  // namespace skel
