// A photographed page lends the figure on it what the drawing does not have: the light that falls on it, the
// shadows cast there, the ruling of the paper.
#pragma once

#include "libskel/image/image.h"
#include "libskel/silhouette/silhouette.h"

namespace skel {

// The picture with the colours of the figure, and of what is close to it, as they would be on white paper in
// even light: divided by the colour that the paper has around it, and what is printed on the paper taken off.
// Empty where nothing is to be taken off: the picture has alpha, its ground is no paper, or a white and even
// one. `silhouette` must be found and belong to `image`.
Image evenLight(const Image& image, const Silhouette& silhouette);

}  // namespace skel
