// A drawing and its moving figure, as a page of HTML shows them.
#pragma once

#include <string>

#include "libskel/pipeline/rig_character.h"

namespace skel {

// Frames of a clip in one picture, line by line, each of kFilmWidth × kFilmHeight px.
struct FilmSheet {
  std::string source, rest;  // data: addresses; `rest`: the figure as it was drawn, seen as in the frames
  int columns = 0, rows = 0;
  double duration_s = 0;
};
inline constexpr int kFilmWidth = 200, kFilmHeight = 240;  // px

struct ReportPictures {
  std::string drawing;  // data: address
  FilmSheet film;       // without columns: the character has no clip
};

// Of the drawing alone: data: address.
std::string reportPicture(const Image& drawing);
// `clip`: the one that is shown, where the character has it; else its dance, its walk, or its first.
// `figure_alone`: of the drawing what lies around the figure is left out, such as the table around the sheet.
ReportPictures reportPictures(const RiggedDrawing& drawing, const std::string& clip, bool figure_alone);

}  // namespace skel
