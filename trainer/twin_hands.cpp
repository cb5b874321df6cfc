#include "trainer/twin_hands.h"

#include <algorithm>
#include <cstdio>

#include "libskel/core/files.h"
#include "libskel/core/sha256.h"
#include "libskel/labels/twins.h"
#include "trainer/confidence_samples.h"

namespace skel {

void uniteTwins(const std::vector<std::string>& images, int folds, Hands& hands) {
  std::vector<std::string> names, sha256s;
  for (const std::string& image : images) {
    names.push_back(drawingName(image));
    sha256s.push_back(sha256(readFile(image)));
  }
  for (const std::vector<std::size_t>& picture : groupedByPicture(sha256s)) {
    if (picture.size() == 1) continue;
    const auto known = std::find_if(picture.begin(), picture.end(),
                                    [&](std::size_t i) { return hands.of_drawing.contains(names[i]); });
    const std::string hand = hands.of(names[known == picture.end() ? picture.front() : *known]);
    for (const std::size_t i : picture) hands.of_drawing[names[i]] = hand;
  }
  if (const std::string twins = twinsSaid("drawings", images, sha256s); folds > 1 && !twins.empty())
    std::fprintf(stderr, "skel-train: note: %s: they are left out together\n", twins.c_str());
}

}  // namespace skel
