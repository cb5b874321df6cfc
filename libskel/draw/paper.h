// Shade on a drawing: on colours all of it, on white paper little, lest line art turns dirty grey.
#pragma once

#include <algorithm>

namespace skel {

// Of the least channel, 0…255: from here on a colour is the paler the less shade it takes, and white takes
// this share.
inline constexpr float kPaleFrom = 150, kShadeOnWhite = 0.42f;

// What all channels are multiplied by, so that the hue stays. `light`: 0…1, what a dark colour would be
// multiplied by; `least`: the colour's least channel, 0…255.
inline float shadeOf(float light, float least) {
  const float pale = std::clamp((least - kPaleFrom) / (255 - kPaleFrom), 0.0f, 1.0f);
  return 1 - (1 - light) * (1 - (1 - kShadeOnWhite) * pale);
}

}  // namespace skel
