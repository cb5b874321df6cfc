// What all painters of random figures share: styles and colours.
#pragma once

#include "libskel/core/rng.h"
#include "trainer/figures/scene.h"

namespace skel {

enum class Style {
  kFlat,     // plain colours
  kCartoon,  // colours with dark outlines
  kPaper,    // outlines on paper
  kHollow,   // nothing but the outlines is figure
};

// Grey to bright by `low` and `high` (0…255), each channel a little apart.
Colour randomColour(Rng& rng, double low, double high);

// Of a part of the figure.
Ink partInk(Style style, const Colour& fill, const Colour& rim, double rim_width);
// Of what is painted on parts: a face, a button.
Ink detail(const Colour& fill);

}  // namespace skel
