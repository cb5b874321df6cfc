#include "libskel/video/palette.h"

#include "libskel/core/rng.h"
#include "tests/support/catch.h"

using namespace skel;

TEST_CASE("few flat colours are kept as they are") {
  const std::vector<Rgb> colors = {{255, 255, 255}, {0, 0, 0}, {200, 30, 60}, {30, 60, 200}};
  std::vector<Rgb> pixels;
  for (int i = 0; i < 400; ++i) pixels.push_back(colors[static_cast<size_t>(i * i) % 4]);
  const Palette palette = choosePalette(pixels, 255);
  for (size_t i = 0; i < pixels.size(); ++i) CHECK(palette.colors[palette.indices[i]] == pixels[i]);
}

TEST_CASE("a palette is never larger than asked for, and all indices lie in it") {
  Rng rng(1);
  std::vector<Rgb> pixels(5000);
  for (Rgb& pixel : pixels)
    for (std::uint8_t& c : pixel) c = static_cast<std::uint8_t>(rng.below(256));
  for (const int most : {1, 2, 3, 17, 255, 256}) {
    const Palette palette = choosePalette(pixels, most);
    CHECK(static_cast<int>(palette.colors.size()) == most);
    CHECK(*std::max_element(palette.indices.begin(), palette.indices.end()) < palette.colors.size());
  }
  CHECK(choosePalette({}, 255).colors.empty());
}

TEST_CASE("more colours come nearer to the picture") {
  std::vector<Rgb> pixels;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      pixels.push_back({static_cast<std::uint8_t>(4 * x), static_cast<std::uint8_t>(4 * y), 128});
  double before = 1e9;
  for (const int most : {4, 16, 64, 255}) {
    const Palette palette = choosePalette(pixels, most);
    double error = 0;
    for (size_t i = 0; i < pixels.size(); ++i)
      for (size_t k = 0; k < 3; ++k) {
        const double d = double(palette.colors[palette.indices[i]][k]) - pixels[i][k];
        error += d * d;
      }
    CHECK(error < before / 3);
    before = error;
  }
  CHECK(std::sqrt(before / 4096) < 7);  // of 255
}
