#include "animator/group_film.h"

#include <algorithm>

#include "libskel/core/natural_order.h"
#include "libskel/draw/canvas.h"

namespace skel {
namespace {

constexpr double kName = 0.04, kLeastName_px = 8;  // height of capitals, of a cell's

// Ink that is seen on the background.
Color inkOn(const Look& look) {
  const Color ground = look.background;
  const bool dark = look.picture.empty() && ground.a == 255 && ground.r + ground.g + ground.b < 3 * 110;
  return dark ? kWhite : kInk;
}

// Names in letters that our font does not have are not written.
void drawName(Image& image, const std::string& name, double middle_x, double base_y, double most_width,
              double height_px, Color ink) {
  const std::string plain = withoutMarks(name);
  if (std::any_of(plain.begin(), plain.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; }))
    return;
  const double width = textWidth(name, height_px), shrunk = std::min(1.0, most_width / std::max(1.0, width));
  drawText(image, {middle_x - shrunk * width / 2, base_y}, name, shrunk * height_px, ink);
}

}  // namespace

CellGrid::CellGrid(int count, int picture_width, int picture_height) {
  int largest = -1;
  for (int of_row = 1; of_row <= count; ++of_row) {
    const int in_column = (count + of_row - 1) / of_row;
    const int side = std::min(picture_width / of_row, picture_height / in_column);
    if (side <= largest) continue;
    largest = side;
    columns = of_row, rows = in_column;
  }
  width = picture_width / columns, height = picture_height / rows;
}

GroupFilm::GroupFilm(const RenderCommandOptions& options, const FilmOptions& film)
    : options_(options), film_(film), grid_(int(options.files.size()), film.width, film.height) {
  if (options.names) name_px_ = std::max(kLeastName_px, kName * grid_.height);
}

bool GroupFilm::add(Performer performer) {
  FilmOptions in_cell = film_;
  in_cell.width = std::max(1, grid_.width);
  in_cell.height = std::max(1, grid_.height - int(2 * name_px_));
  in_cell.look.background = kClear;
  in_cell.look.picture = Image();
  Cell& cell = cells_.emplace_back(Cell{std::move(performer), nullptr, {}});
  bool torn = false;
  try {
    cell.stage = std::make_unique<Stage>(options_, cell.performer);
    torn = cell.stage->sayTorn(cell.performer.clips.front());
    cell.paint = cell.stage->painterOf(cell.performer.clips.front(), in_cell);
  } catch (...) {
    cells_.pop_back();
    throw;
  }
  frames_ = std::max(frames_, skel::frameCount(cell.performer.clips.front(), film_));
  // Photos of a whole class would take gigabytes.
  cell.stage->forgetPictures();
  if (std::optional<RiggedDrawing>& drawing = cell.performer.flat) {
    drawing->image = drawing->even_light = Image();
    drawing->silhouette = Silhouette();
    drawing->layers = LayerMap();
    drawing->found_limbs = Plane8();
    drawing->character.mesh.texture = Image();
    cell.performer.file.character = RiggedCharacter();
  }
  return torn;
}

Eigen::Vector2i GroupFilm::cornerOf(std::size_t cell) const {
  const int i = int(cell), count = int(cells_.size()), row = i / grid_.columns,
            rows = (count + grid_.columns - 1) / grid_.columns,
            in_row = std::min(grid_.columns, count - row * grid_.columns);
  return {(film_.width - in_row * grid_.width) / 2 + i % grid_.columns * grid_.width,
          (film_.height - rows * grid_.height) / 2 + row * grid_.height};
}

bool GroupFilm::isConcurrent() const {
  return std::all_of(cells_.begin(), cells_.end(),
                     [](const Cell& cell) { return cell.stage->isConcurrent(); });
}

Image GroupFilm::paint(int frame) const {
  Image image = paintBackground(film_.look, film_.width, film_.height);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Eigen::Vector2i corner = cornerOf(i);
    blit(image, cells_[i].paint(timeOf(frame, cells_[i].performer.clips.front(), film_)), corner.x(),
         corner.y());
    if (name_px_ > 0)
      drawName(image, cells_[i].performer.file.name, corner.x() + grid_.width / 2.0,
               corner.y() + grid_.height - name_px_ / 2, 0.95 * grid_.width, name_px_, inkOn(film_.look));
  }
  return image;
}

}  // namespace skel
