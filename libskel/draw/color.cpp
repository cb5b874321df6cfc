#include "libskel/draw/color.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

#include "libskel/core/error.h"

namespace skel {

std::optional<Color> backgroundColor(std::string_view text) {
  if (text == "white") return kWhite;
  if (text == "black") return Color{};
  if (text == "grey") return Color{224, 227, 233};
  if (text == "none" || text == "transparent") return kClear;
  if (!text.starts_with('#')) return std::nullopt;
  unsigned value = 0;
  const auto parsed = std::from_chars(text.data() + 1, text.data() + text.size(), value, 16);
  if (text.size() != 7 || parsed.ptr != text.data() + text.size())
    throw UsageError("--background is \"" + std::string(text) + "\"; a colour is written #rrggbb");
  return Color{std::uint8_t(value >> 16), std::uint8_t(value >> 8), std::uint8_t(value)};
}

Color classColor(std::string_view name) {
  if (name == "head") return kHeadClass;
  if (name == "body") return kBodyClass;
  if (name == "hand") return kHandClass;
  if (name == "leg") return kLegClass;
  return kGrey;
}

Color sideColor(std::string_view joint) {
  if (joint.starts_with("left_")) return kLeft;
  if (joint.starts_with("right_")) return kRight;
  return kMiddle;
}

Color heatColor(double t) {
  constexpr std::array<Color, 6> kStops = {
      {{18, 14, 44}, {52, 44, 120}, {128, 50, 140}, {214, 76, 92}, {248, 156, 58}, {252, 244, 176}}};
  const double at = std::clamp(t, 0.0, 1.0) * (kStops.size() - 1);
  const std::size_t i = std::min(std::size_t(at), kStops.size() - 2);
  const double f = at - double(i);
  const auto mix = [&](std::uint8_t a, std::uint8_t b) { return std::uint8_t(std::lround(a + f * (b - a))); };
  return {mix(kStops[i].r, kStops[i + 1].r), mix(kStops[i].g, kStops[i + 1].g),
          mix(kStops[i].b, kStops[i + 1].b)};
}

}  // namespace skel
