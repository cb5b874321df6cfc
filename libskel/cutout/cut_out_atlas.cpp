#include "libskel/cutout/cut_out_atlas.h"

#include <algorithm>
#include <cmath>

#include "libskel/core/check.h"
#include "libskel/draw/canvas.h"

namespace skel {
namespace {

constexpr int kTileRim =
    1;  // texels about a tile, which lie between it and the next when the picture is drawn smaller

// The square and its rim, from `left`, `top` of the picture on. Of what other copies of the square show it
// has nothing.
void copyTile(const CutOutSheet& sheet, std::size_t square, int left, int top, Image& picture) {
  const Lattice& lattice = sheet.lattice;
  const Eigen::Vector2i corner = lattice.corners_px[square];
  for (int y = -kTileRim; y < lattice.side_px + kTileRim; ++y)
    for (int x = -kTileRim; x < lattice.side_px + kTileRim; ++x) {
      const int u = corner.x() + x, v = corner.y() + y;
      if (u < 0 || v < 0 || u >= sheet.picture.width || v >= sheet.picture.height) continue;
      const bool inside = x >= 0 && y >= 0 && x < lattice.side_px && y < lattice.side_px;
      const int of = lattice.square_of(v, u);
      if (inside && of >= 0 && of != int(square)) continue;
      const std::uint8_t* from = sheet.picture.pixel(u, v);
      std::uint8_t* to = picture.pixel(left + kTileRim + x, top + kTileRim + y);
      for (int c = 0; c < 3; ++c) to[c] = std::uint8_t((from[c] * from[3] + 127) / 255);
      to[3] = from[3];
    }
}

}  // namespace

CutOutAtlas atlasOf(const CutOut& cut_out, int most_px) {
  SKEL_CHECK(most_px >= 1);
  int tile = 1;
  std::vector<std::uint32_t> first;  // of each sheet: its first vertex among all
  std::uint32_t vertices = 0;
  for (const CutOutSheet& sheet : cut_out.sheets) {
    tile = std::max(tile, sheet.lattice.side_px + 2 * kTileRim);
    first.push_back(vertices);
    vertices += std::uint32_t(sheet.lattice.vertices.rows());
  }
  const int count = std::max(1, int(cut_out.patches.size()));
  const int columns = int(std::ceil(std::sqrt(double(count)))), rows = (count + columns - 1) / columns;
  CutOutAtlas atlas;
  atlas.picture = Image(columns * tile, rows * tile);
  atlas.picture.rgba.setZero();
  atlas.texcoords.resize(4 * Eigen::Index(cut_out.patches.size()), 2);
  for (std::size_t p = 0; p < cut_out.patches.size(); ++p) {
    const CutOut::Patch& patch = cut_out.patches[p];
    const CutOutSheet& sheet = cut_out.sheets[patch.sheet];
    const int left = int(p) % columns * tile, top = int(p) / columns * tile;
    copyTile(sheet, patch.square, left, top, atlas.picture);
    const std::uint32_t corner = std::uint32_t(4 * p);
    for (int k = 0; k < 4; ++k) {
      atlas.texcoords.row(Eigen::Index(corner) + k)
          << float(left + kTileRim + k % 2 * sheet.lattice.side_px) / float(columns * tile),
          float(top + kTileRim + k / 2 * sheet.lattice.side_px) / float(rows * tile);
      atlas.vertex.push_back(first[patch.sheet] +
                             std::uint32_t(sheet.lattice.squares[patch.square][std::size_t(k)]));
    }
    for (const auto& half : sheet.lattice.halves(patch.square))
      for (const std::size_t k : half) atlas.triangles.push_back(corner + std::uint32_t(k));
  }
  if (const int longest = std::max(atlas.picture.width, atlas.picture.height); longest > most_px)
    atlas.picture =
        resized(atlas.picture, std::max(1, int(std::int64_t(atlas.picture.width) * most_px / longest)),
                std::max(1, int(std::int64_t(atlas.picture.height) * most_px / longest)));
  return atlas;
}

}  // namespace skel
