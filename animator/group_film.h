// Several characters in one film.
#pragma once

#include <deque>
#include <vector>

#include "animator/stage.h"

namespace skel {

// Cells of a picture, in rows from the top, as large as they go.
struct CellGrid {
  int columns = 1, rows = 1;
  int width = 0, height = 0;  // of a cell, px

  CellGrid(int count, int picture_width, int picture_height);
};

// Each in a cell of its own, as large as it goes, all at the same time of their clips.
class GroupFilm {
 public:
  // Of as many characters as `options` names, or less. The options outlive it.
  GroupFilm(const RenderCommandOptions& options, const FilmOptions& film);

  // Its first clip plays. Returns whether that tears it.
  bool add(Performer performer);

  std::size_t size() const { return cells_.size(); }
  // The longest clip is played once, if no time is asked for; the others repeat.
  int frameCount() const { return frames_; }
  bool isConcurrent() const;
  Image paint(int frame) const;

 private:
  struct Cell {
    Performer performer;
    std::unique_ptr<Stage> stage;
    MomentPainter paint;
  };
  Eigen::Vector2i cornerOf(std::size_t cell) const;

  const RenderCommandOptions& options_;
  FilmOptions film_;
  CellGrid grid_;
  double name_px_ = 0;  // height of capitals; 0: no names
  int frames_ = 1;
  std::deque<Cell> cells_;  // which point into themselves
};

}  // namespace skel
