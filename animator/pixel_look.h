// Pictures as pixel artists draw them: few colours, hard edges, an outline of one pixel.
#pragma once

#include <string>
#include <vector>

#include "libskel/draw/color.h"
#include "libskel/image/image.h"

namespace skel {

// One pixel for each square of `factor`·`factor` pixels: opaque where at least half of the square is covered,
// in the one of its colours that is nearest to all of them. Nothing is mixed. The sides of `large` are
// multiples of `factor`.
Image pixelated(const Image& large, int factor);

// Of what can be seen in a picture, at most 256. Throws InputError: none, or more.
std::vector<Color> paletteOf(const Image& picture, const std::string& path);

// What can be seen gets the nearest of these colours.
void takeColors(std::vector<Image>& pictures, const std::vector<Color>& palette);

// What can be seen gets at most `colors` (1…256) different colours, the same ones in all pictures.
void reduceColors(std::vector<Image>& pictures, int colors);

// The clear pixels beside the opaque ones.
void addOutline(Image& picture, Color color);

// Of what can be seen.
Color darkestColor(const std::vector<Image>& pictures);

}  // namespace skel
