// Which pixels of a film's frame are the figure.
#pragma once

#include <vector>

#include "libskel/image/image.h"

namespace skel {

// The picture behind a figure that moves: at each pixel the median of the frames, per channel. Frames of one
// size, at least one.
Image stillBackground(const std::vector<Image>& frames);

struct ForegroundOptions {
  double cutoff = 0.5;  // of the low-pass in the Fourier domain (low_pass.h) that takes noise away
  double difference =
      0.11;  // from the background, of the largest there can be: from here on it is the figure
};

// 255 where a frame differs from the background, by the channel that differs most.
Plane8 foreground(const Image& frame, const Image& background, const ForegroundOptions& options = {});

// 255 where the frame's alpha, low-passed in the same way, is at least one half.
Plane8 opaquePart(const Image& frame, const ForegroundOptions& options = {});

// Whether a picture has transparent pixels at all: one in a thousand at least.
bool hasTransparency(const Image& frame);

}  // namespace skel
