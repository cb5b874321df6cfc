// IEC 61966-2-1.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace skel {

// Of linear light, which is taken as 0 to 1 where it lies beyond.
inline std::uint8_t srgbFromLinear(float light) {
  light = std::clamp(light, 0.0f, 1.0f);
  const float s = light <= 0.0031308f ? 12.92f * light : 1.055f * std::pow(light, 1 / 2.4f) - 0.055f;
  return std::uint8_t(std::lround(255 * s));
}

// The way back, of 0…255: 0…1.
inline float linearFromSrgb(float value) {
  const float s = value / 255;
  return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
}

}  // namespace skel
