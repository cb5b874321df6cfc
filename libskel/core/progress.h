// How far a work is, on stderr, for whatever takes longer than a second.
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace skel {

// A bar where stderr is a terminal; elsewhere a line now and then: after five seconds, then with pauses that
// grow with the work. May be called from several threads.
class ProgressBar {
 public:
  // `total` 0: nobody knows. `shown`: false says nothing at all.
  ProgressBar(std::string title, std::size_t total, bool shown = true);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // `note` stands behind the bar, e.g. the loss.
  void advance(std::size_t steps = 1, const std::string& note = {});
  // There are so many more than was thought.
  void expect(std::size_t more);
  // Takes the bar away so that a message can be printed; the next advance() draws it again.
  void clear();

 private:
  double elapsed_s() const;
  void draw();

  std::string title_, note_;
  std::size_t total_, done_ = 0;
  bool shown_, terminal_, drawn_ = false;
  std::chrono::steady_clock::time_point start_, last_;
  std::mutex mutex_;
};

// "rigging: 12 of 24, 0:10 left", and the note if there is one. 0 < done <= total. `total` 0: "rigging: 12 in
// 0:10".
std::string progressLine(const std::string& title, std::size_t done, std::size_t total, double elapsed_s,
                         const std::string& note);

// How long after that time a log gets its next line, s.
double pauseBetweenLines_s(double elapsed_s);

}  // namespace skel
