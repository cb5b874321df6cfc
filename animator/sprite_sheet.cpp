#include "animator/sprite_sheet.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "libskel/core/error.h"
#include "libskel/draw/canvas.h"

namespace skel {
namespace {

// Of what is not clear; a pixel where all is.
Box boundsOf(const Image& image) {
  int x0 = image.width, y0 = image.height, x1 = -1, y1 = -1;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (image.pixel(x, y)[3] > 0)
        x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
  return x1 < 0 ? Box{0, 0, 1, 1} : Box{x0, y0, x1 - x0 + 1, y1 - y0 + 1};
}

std::vector<PlacedSprite> placeEven(const std::vector<SpriteTag>& tags, const SpriteCell& cell) {
  constexpr int kMostColumns = 16;
  std::vector<PlacedSprite> placed;
  int row = 0;
  for (const SpriteTag& tag : tags) {
    int column = 0;
    for (int i = tag.first; i <= tag.last; ++i, ++column) {
      if (column == kMostColumns) column = 0, ++row;
      placed.push_back({{column * cell.width, row * cell.height, cell.width, cell.height},
                        {0, 0, cell.width, cell.height}});
    }
    ++row;
  }
  return placed;
}

// In rows, the highest first, of a width that makes the sheet about square.
std::vector<PlacedSprite> placeTrimmed(const std::vector<Sprite>& sprites) {
  constexpr int kGap = 1;
  std::vector<PlacedSprite> placed(sprites.size());
  double area = 0;
  int widest = 0;
  for (std::size_t i = 0; i < sprites.size(); ++i) {
    const Box box = placed[i].in_cell = boundsOf(sprites[i].image);
    area += double(box.width + kGap) * (box.height + kGap);
    widest = std::max(widest, box.width);
  }
  int width = 64;
  while (width < widest || width < std::sqrt(area)) width *= 2;
  std::vector<std::size_t> order(sprites.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return placed[a].in_cell.height > placed[b].in_cell.height;
  });
  int x = 0, y = 0, row_height = 0;
  for (const std::size_t i : order) {
    const Box& box = placed[i].in_cell;
    if (x + box.width > width) x = 0, y += row_height + kGap, row_height = 0;
    placed[i].in_sheet = {x, y, box.width, box.height};
    x += box.width + kGap;
    row_height = std::max(row_height, box.height);
  }
  return placed;
}

Box extentOf(const std::vector<PlacedSprite>& placed) {
  Box all;
  for (const auto& [box, in_cell] : placed)
    all.width = std::max(all.width, box.x + box.width), all.height = std::max(all.height, box.y + box.height);
  return all;
}

void checkExtent(const Box& sheet) {
  if (std::max(sheet.width, sheet.height) > kLongestSheet_px)
    throw UsageError("the sheet would be " + std::to_string(sheet.width) + "x" +
                     std::to_string(sheet.height) +
                     " px; take a smaller --size, fewer --frames, clips or --directions");
}

}  // namespace

void checkSheetSize(const std::vector<SpriteTag>& tags, const SpriteCell& cell, SpritePacking packing) {
  if (std::max(cell.width, cell.height) > kLongestCell_px)
    throw UsageError("the frames of a sheet have at most " + std::to_string(kLongestCell_px) + " px a side");
  const double sprites = tags.empty() ? 0 : tags.back().last + 1.0;
  if (sprites > kMostSprites)
    throw UsageError("a sheet has at most " + std::to_string(kMostSprites) +
                     " frames; take fewer --frames, clips or --directions");
  // Trimmed ones may leave nothing out.
  const int side = int(std::sqrt(sprites * cell.width * cell.height));
  checkExtent(packing == SpritePacking::kEven ? extentOf(placeEven(tags, cell)) : Box{0, 0, side, side});
}

SpriteSheet packSprites(const std::vector<Sprite>& sprites, const std::vector<SpriteTag>& tags,
                        const SpriteCell& cell, SpritePacking packing) {
  SpriteSheet sheet;
  sheet.placed = packing == SpritePacking::kEven ? placeEven(tags, cell) : placeTrimmed(sprites);
  const Box extent = extentOf(sheet.placed);
  checkExtent(extent);
  sheet.picture = blankImage(extent.width, extent.height, kClear);
  for (std::size_t i = 0; i < sprites.size(); ++i) {
    const auto& [to, from] = sheet.placed[i];
    for (int row = 0; row < to.height; ++row)
      std::copy_n(sprites[i].image.pixel(from.x, from.y + row), 4 * to.width,
                  sheet.picture.pixel(to.x, to.y + row));
  }
  return sheet;
}

}  // namespace skel
