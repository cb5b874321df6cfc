#include "libskel/mesh/texture_atlas.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace skel {
namespace {

// A tile's whole repeats and its place.
struct Place {
  int first_u = 0, first_v = 0, times_u = 1, times_v = 1;
  int x = 0, y = 0, width = 0, height = 0;  // without the rim
};

// Rows of at most `most_px`; returns the height that they need.
std::int64_t arrange(std::vector<Place>& places, const std::vector<int>& order, int most_px) {
  std::int64_t x = 0, y = 0, row = 0;
  for (const int k : order) {
    Place& place = places[static_cast<std::size_t>(k)];
    const int width = place.width + 2 * kAtlasRim, height = place.height + 2 * kAtlasRim;
    if (x > 0 && x + width > most_px) x = 0, y += row, row = 0;
    place.x = static_cast<int>(x) + kAtlasRim;
    place.y = static_cast<int>(std::min<std::int64_t>(y, 1 << 30)) + kAtlasRim;
    x += width;
    row = std::max<std::int64_t>(row, height);
  }
  return y + row;
}

}  // namespace

TextureAtlas packAtlas(const std::vector<AtlasTile>& tiles) {
  TextureAtlas atlas;
  std::vector<Place> places;
  double area = 0;
  int widest = 0;
  for (const AtlasTile& tile : tiles) {
    Place place;
    const Eigen::Array2f first = tile.low.floor(), last = tile.high.ceil();
    const Eigen::Array2f times = (last - first).max(1.0f);
    if (!(times.x() * static_cast<float>(tile.image.width) <= kMaxAtlas_px &&
          times.y() * static_cast<float>(tile.image.height) <= kMaxAtlas_px && first.abs().maxCoeff() < 1e6f))
      return atlas;
    place.first_u = static_cast<int>(first.x()), place.first_v = static_cast<int>(first.y());
    place.times_u = static_cast<int>(times.x()), place.times_v = static_cast<int>(times.y());
    place.width = place.times_u * tile.image.width, place.height = place.times_v * tile.image.height;
    area += static_cast<double>(place.width + 2 * kAtlasRim) * (place.height + 2 * kAtlasRim);
    widest = std::max(widest, place.width + 2 * kAtlasRim);
    places.push_back(place);
  }
  std::vector<int> order(tiles.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return places[a].height > places[b].height; });
  // About square.
  const int side =
      std::clamp(std::max(widest, static_cast<int>(std::ceil(std::sqrt(area)))), 1, kMaxAtlas_px);
  const std::int64_t height = arrange(places, order, side);
  if (height > kMaxAtlas_px || widest > kMaxAtlas_px) return atlas;
  int width = 0;
  for (const Place& place : places) width = std::max(width, place.x + place.width + kAtlasRim);
  atlas.image = Image(width, static_cast<int>(height));
  atlas.image.rgba.setConstant(255);
  for (std::size_t k = 0; k < tiles.size(); ++k) {
    const Place& place = places[k];
    const Image& from = tiles[k].image;
    for (int y = -kAtlasRim; y < place.height + kAtlasRim; ++y) {
      const int sy = std::clamp(y, 0, place.height - 1) % from.height;
      for (int x = -kAtlasRim; x < place.width + kAtlasRim; ++x) {
        const int sx = std::clamp(x, 0, place.width - 1) % from.width;
        std::memcpy(atlas.image.pixel(place.x + x, place.y + y), from.pixel(sx, sy), 4);
        // The rest of a whole tile's row at once.
        if (sx == 0 && x >= 0 && x + from.width <= place.width) {
          std::memcpy(atlas.image.pixel(place.x + x, place.y + y), from.pixel(0, sy),
                      4 * std::size_t(from.width));
          x += from.width - 1;
        }
      }
    }
    const Eigen::Array2f whole(static_cast<float>(atlas.image.width), static_cast<float>(atlas.image.height));
    const Eigen::Array2f tile(static_cast<float>(from.width), static_cast<float>(from.height));
    const Eigen::Array2f corner(static_cast<float>(place.x - place.first_u * from.width),
                                static_cast<float>(place.y - place.first_v * from.height));
    atlas.scale.push_back(tile / whole);
    atlas.offset.push_back(corner / whole);
  }
  return atlas;
}

}  // namespace skel
