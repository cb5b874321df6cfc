// What a motion in a work folder was made of, so that it is taken up for the same film alone.
#pragma once

#include <string>

#include "stylizer/film_figure.h"

namespace skel {

// Of the film's bytes, or its frames', and of how the figure is found in them. Throws InputError as
// readVideo() does.
std::string filmHash(const FilmSource& film);

enum class MotionIsOf {
  kThisFilm,
  kAnotherFilm,        // or nobody knows: to be made anew
  kAnotherFilmMended,  // the same, and a person has changed it since
};

// Of the motion file at `path`, which is there, by what leaveTrace() has left beside it. Where that is
// missing: `film_name` and the motion's own source tell, and joints that a person has placed. Throws
// InputError.
MotionIsOf filmOfMotion(const std::string& path, const std::string& film_hash, const std::string& film_name);

// The trace of the motion at `path` is forgotten before a new one is written there, and left after it, so
// that who is killed in between leaves none that is wrong. Throws OutputError.
void forgetTrace(const std::string& path);
void leaveTrace(const std::string& path, const std::string& film_hash);

}  // namespace skel
