#include "stylizer/film_trace.h"

#include <algorithm>
#include <filesystem>

#include "libskel/core/files.h"
#include "libskel/core/input_guard.h"
#include "libskel/core/sha256.h"
#include "libskel/skeleton/motion_file.h"

namespace skel {
namespace {
namespace fs = std::filesystem;

std::string traceOf(const std::string& path) {
  return path.substr(0, path.size() - std::string(kMotionFileEnding).size()) + ".made-of.txt";
}

// "film <hash>\nmotion <hash>\n"
std::string traceText(const std::string& film_hash, const std::string& motion) {
  return "film " + film_hash + "\nmotion " + sha256(motion) + "\n";
}

bool isPlacedByHand(const MotionFrame& frame) {
  return std::any_of(frame.joints.begin(), frame.joints.end(),
                     [](const auto& joint) { return joint && joint->origin == JointOrigin::kEdited; });
}

}  // namespace

std::string filmHash(const FilmSource& film) {
  std::string text = film.figure + " " + std::to_string(film.foreground.cutoff) + " " +
                     std::to_string(film.foreground.difference) + "\n";
  readVideo(film.path, film.frame_rate);  // says what is no film
  if (!fs::is_directory(film.path)) return sha256(text + readFile(film.path));
  text += std::to_string(film.frame_rate) + "\n";
  for (const std::string& frame : framesIn(film.path)) text += sha256(readFile(frame)) + "\n";
  return sha256(text);
}

MotionIsOf filmOfMotion(const std::string& path, const std::string& film_hash, const std::string& film_name) {
  const LookAtOutputs look;
  const std::string motion = readFile(path), trace = traceOf(path);
  if (const std::string text = fs::exists(trace) ? readFile(trace) : ""; !text.empty()) {
    if (text.starts_with("film " + film_hash + "\n")) return MotionIsOf::kThisFilm;
    const bool as_made = text.ends_with("\nmotion " + sha256(motion) + "\n");
    return as_made ? MotionIsOf::kAnotherFilm : MotionIsOf::kAnotherFilmMended;
  }
  const MotionFile file = readMotionFile(path, loadTemplate("biped"));
  if (std::none_of(file.frames.begin(), file.frames.end(), isPlacedByHand)) return MotionIsOf::kAnotherFilm;
  return file.source == film_name ? MotionIsOf::kThisFilm : MotionIsOf::kAnotherFilmMended;
}

void forgetTrace(const std::string& path) {
  if (fs::exists(traceOf(path))) writeFile(traceOf(path), "");
}

void leaveTrace(const std::string& path, const std::string& film_hash) {
  const LookAtOutputs look;
  writeFile(traceOf(path), traceText(film_hash, readFile(path)));
}

}  // namespace skel
