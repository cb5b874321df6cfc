// The colours of skel's pictures, in one place.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace skel {

struct Color {
  std::uint8_t r = 0, g = 0, b = 0, a = 255;

  Color withAlpha(std::uint8_t alpha) const { return {r, g, b, alpha}; }
};

inline constexpr Color kWhite{255, 255, 255}, kInk{38, 40, 46}, kGrey{140, 143, 150}, kClear{0, 0, 0, 0};

// Sides of a skeleton; blue and orange, so that the colour-blind tell them apart as well.
inline constexpr Color kLeft{32, 113, 214}, kRight{238, 116, 20}, kMiddle{110, 66, 170};

// Classes of candidates.
inline constexpr Color kHeadClass{204, 51, 119}, kBodyClass{120, 94, 200}, kHandClass{240, 146, 20},
    kLegClass{20, 150, 120};

// white, black, grey, none (clear) or #rrggbb; nothing for any other text. Throws UsageError: # and no
// colour.
std::optional<Color> backgroundColor(std::string_view text);

// By the class's name (head, body, hand, leg); grey for any other.
Color classColor(std::string_view name);

// By the prefix of the joint's name: left_, right_, or neither.
Color sideColor(std::string_view joint);

// From dark blue over red to light yellow for t in [0, 1]; brightness grows with t.
Color heatColor(double t);

}  // namespace skel
