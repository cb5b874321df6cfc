// Annotated drawings on the pages of trainer/pages/hard_pages.h.
#pragma once

#include <string>
#include <vector>

#include "libskel/core/parallel.h"
#include "libskel/image/read_image.h"
#include "libskel/labels/annotated_image.h"
#include "trainer/pages/hard_pages.h"

namespace skel {

// Those below the folders that have a mask; one of `every` in each.
inline std::vector<AnnotatedImage> drawingsWithMask(const std::vector<std::string>& folders, int every = 1) {
  std::vector<AnnotatedImage> drawings;
  for (const std::string& folder : folders) {
    int number = 0;
    for (const AnnotatedImage& drawing : findAnnotatedImages(folder))
      if (drawing.mask && number++ % every == 0) drawings.push_back(drawing);
  }
  return drawings;
}

inline PageArt artOf(const AnnotatedImage& drawing) {
  const Image image = readImage(drawing.image);
  return pageArt(image, readMaskOf(image, *drawing.mask));
}

// use(c, i, page): drawing `i` in circumstance `c`, beside the next one where that shows two. Several at
// once.
template <class Use>
void forEachPage(const std::vector<AnnotatedImage>& drawings, const std::vector<Circumstance>& all,
                 const Use& use) {
  parallelFor(drawings.size(), 1, [&](std::size_t i) {
    const PageArt art = artOf(drawings[i]), beside = artOf(drawings[(i + 1) % drawings.size()]);
    for (std::size_t c = 0; c < all.size(); ++c) {
      Rng rng(i, c);
      use(c, i, all[c].compose(rng, art, beside));
    }
  });
}

}  // namespace skel
