// How light a colour is to those who look for drawn lines.
#pragma once

#include <algorithm>

namespace skel {

// 0…255. Black lines stand out from full red and blue as they do from paper, which they hardly do by
// brightness alone.
template <class Channel>
double inkLightness(Channel r, Channel g, Channel b) {
  const double brightness = 0.299 * double(r) + 0.587 * double(g) + 0.114 * double(b);
  return 0.75 * brightness + 0.25 * double(std::max({r, g, b}));
}

}  // namespace skel
